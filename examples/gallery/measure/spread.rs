//! A figure over several seeds: its mean and how far the seeds differ, computed on all processors in a fixed order.

use std::{
    ops::RangeInclusive,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use super::exhibit::NoFilm;

/// Seeds over which means are taken.
pub const SEEDS: RangeInclusive<u64> = 1..=5;

/// Mean of a figure over seeds, and its spread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    pub mean: f64,
    /// Standard deviation of the seeds, not of the mean.
    pub deviation: f64,
    /// Number of seeds.
    pub count: usize,
}

impl Spread {
    /// Returns the spread of `values`; that of a single value has no deviation.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count.max(1) as f64;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
        Self { mean, deviation, count }
    }
}

/// Runs `work` for 0 to `count - 1` on all processors. The results are in that order.
pub fn in_parallel<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let (next, found) = (AtomicUsize::new(0), Mutex::new(Vec::with_capacity(count)));
    let workers = thread::available_parallelism().map_or(1, usize::from).min(count);
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    let result = work(index);
                    found.lock().unwrap_or_else(PoisonError::into_inner).push((index, result));
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
    found.sort_by_key(|(index, _)| *index);
    found.into_iter().map(|(_, result)| result).collect()
}

/// Measures `of` with every seed of [`SEEDS`]: the spread of each of its figures.
///
/// # Errors
/// The first error of `of`.
pub fn over_seeds<const N: usize>(of: impl Fn(u64) -> Result<[f64; N], NoFilm> + Sync) -> Result<[Spread; N], NoFilm> {
    let seeds: Vec<u64> = SEEDS.collect();
    let rows = in_parallel(seeds.len(), |index| of(seeds[index])).into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(spreads(&rows))
}

/// Returns the spread of each column of `rows`.
pub fn spreads<const N: usize>(rows: &[[f64; N]]) -> [Spread; N] {
    std::array::from_fn(|column| Spread::of(&rows.iter().map(|row| row[column]).collect::<Vec<_>>()))
}
