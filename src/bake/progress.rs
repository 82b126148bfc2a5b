//! Tells how far ageing has come.

/// Receiver of news about how far ageing has come. It is told from several threads at once; `()` ignores it.
///
/// ```
/// use std::sync::atomic::{AtomicU64, Ordering};
///
/// use bevy_coating::bake::{BakeOptions, Images, Input, Progress, Stopwatch, bake};
///
/// #[derive(Default)]
/// struct Counter {
///     all: AtomicU64,
///     done: AtomicU64,
/// }
///
/// impl Progress for Counter {
///     fn begin(&self, work: u64) {
///         self.all.store(work, Ordering::Relaxed);
///     }
///     fn advance(&self, work: u64) {
///         self.done.fetch_add(work, Ordering::Relaxed);
///     }
/// }
///
/// let model = Input::parse("disk:60".as_ref())?.read(0, Images::Skip)?;
/// let counter = Counter::default();
/// bake(model, &BakeOptions { age: 0.05, ..BakeOptions::default() }, Stopwatch::start(), &counter)?;
/// assert_eq!(counter.done.into_inner(), counter.all.into_inner());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Progress: Sync {
    /// Receives how much work there will be, before ageing begins.
    fn begin(&self, work: u64);
    /// Receives how much more of that work is done.
    fn advance(&self, work: u64);
}

impl Progress for () {
    fn begin(&self, _: u64) {}
    fn advance(&self, _: u64) {}
}
