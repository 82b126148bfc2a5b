//! Long work in pieces, between which something else may go on.

use std::{
    pin::pin,
    task::{Context, Poll, Waker},
};

/// Number of vertices or edges that make a piece.
pub(super) const PIECE: usize = 256;

/// Rests between the pieces of long work.
pub(crate) trait Rest {
    /// Lets something else go on, if it is time for it.
    fn rest(&mut self) -> impl Future<Output = ()> + Send;
}

/// No rest at all, for work that is done [at once](at_once).
pub(super) struct NoRest;

impl Rest for NoRest {
    async fn rest(&mut self) {}
}

/// Does work to its end. It has [no rest](NoRest), so that it never waits.
pub(super) fn at_once<T>(work: impl Future<Output = T>) -> T {
    let mut work = pin!(work);
    loop {
        if let Poll::Ready(result) = work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return result;
        }
    }
}
