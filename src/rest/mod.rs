//! Long work in pieces, between which something else may go on.

mod runs;
#[cfg(test)]
mod tests;

use std::{
    ops::Range,
    pin::pin,
    task::{Context, Poll, Waker},
};

pub(crate) use runs::{end_of_runs, sort_by_number};

/// Number of vertices, edges or faces that make a piece of heavy work: up to some microseconds each.
pub(crate) const PIECE: usize = 256;

/// Number of entries of a list that make a piece of light work: some tens of nanoseconds each.
pub(crate) const LIGHT_PIECE: usize = 16 * PIECE;

/// Rests between the pieces of long work.
pub(crate) trait Rest: Send {
    /// Lets something else go on, if it is time for it.
    fn rest(&mut self) -> impl Future<Output = ()> + Send;
}

/// No rest at all, for work that is done [at once](at_once).
pub(crate) struct NoRest;

impl Rest for NoRest {
    async fn rest(&mut self) {}
}

/// Does work to its end. It has [no rest](NoRest), so that it never waits.
pub(crate) fn at_once<T>(work: impl Future<Output = T>) -> T {
    let mut work = pin!(work);
    loop {
        if let Poll::Ready(result) = work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return result;
        }
    }
}

/// Returns the ranges that divide so many entries into pieces of `piece` each, and a last one of what is left.
pub(crate) fn pieces(count: usize, piece: usize) -> impl Iterator<Item = Range<usize>> + Send + use<> {
    (0..count.div_ceil(piece)).map(move |i| i * piece..count.min((i + 1) * piece))
}
