//! Pure functions from records to what is drawn.
