//! Cancellation of work in the background: the work looks at a token, and the one who wants the result cancels it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that tells work to end early. Clones share the flag; once cancelled, it stays so.
#[derive(Clone, Debug, Default)]
pub struct CancelToken {
    is_cancelled: Arc<AtomicBool>,
}

impl CancelToken {
    /// Tells the work to end.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::SeqCst);
    }

    /// Returns whether the work should end.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::SeqCst)
    }
}

/// Owner of a [`CancelToken`] that cancels it when dropped.
#[derive(Debug, Default)]
pub struct CancelOnDrop {
    token: CancelToken,
}

impl CancelOnDrop {
    /// Returns the token, to be given to the work.
    pub fn token(&self) -> CancelToken {
        self.token.clone()
    }
}

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.token.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_share_the_flag() {
        let token = CancelToken::default();
        let other = token.clone();
        assert!(!other.is_cancelled());
        token.cancel();
        assert!(other.is_cancelled());
    }

    #[test]
    fn dropping_the_owner_cancels() {
        let owner = CancelOnDrop::default();
        let token = owner.token();
        assert!(!token.is_cancelled());
        drop(owner);
        assert!(token.is_cancelled());
    }
}
