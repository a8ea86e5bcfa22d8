//! Rays, boxes, transforms.
