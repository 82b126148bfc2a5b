//! Sorts long lists, and walks over runs of equal entries, in pieces.

use super::{LIGHT_PIECE, Rest, pieces};

/// Returns the same entries in their order, with rests between the pieces of the work. `number` is what counts first in
/// that order.
///
/// Entries are dealt out by their numbers, a few to each place, and sorted there. Where very many have the same number
/// the sorting of these is one piece.
pub(crate) async fn sort_by_number<T: Copy + Ord + Send + Sync>(
    items: Vec<T>,
    number: impl Fn(&T) -> u32 + Send + Sync,
    rest: &mut impl Rest,
) -> Vec<T> {
    let Some(&first) = items.first() else { return items };
    let mut most = 0;
    for piece in items.chunks(LIGHT_PIECE) {
        most = piece.iter().map(&number).fold(most, u32::max);
    }
    // Numbers may be far apart: no more places than entries.
    let shift = (0..32).find(|&shift| (most >> shift) as usize <= items.len()).unwrap_or_default();
    let place = |item: &T| (number(item) >> shift) as usize;
    let mut ends = vec![0_u32; (most >> shift) as usize + 1];
    for piece in items.chunks(LIGHT_PIECE) {
        piece.iter().for_each(|item| ends[place(item)] += 1);
        rest.rest().await;
    }
    let mut sum = 0;
    for count in &mut ends {
        (*count, sum) = (sum, sum + *count);
    }
    let mut sorted = vec![first; items.len()];
    for piece in items.chunks(LIGHT_PIECE) {
        for item in piece {
            let next = &mut ends[place(item)];
            sorted[*next as usize] = *item;
            *next += 1;
        }
        rest.rest().await;
    }
    // Each place now ends where the next one begins.
    let (mut begin, mut done) = (0, 0);
    for range in pieces(ends.len(), LIGHT_PIECE) {
        for &end in &ends[range] {
            sorted[begin..end as usize].sort_unstable();
            begin = end as usize;
        }
        if begin - done >= LIGHT_PIECE {
            done = begin;
            rest.rest().await;
        }
    }
    sorted
}

/// Returns where the piece of a sorted list ends that begins at `from`, a little after [`LIGHT_PIECE`] entries: no run
/// of entries that are the `same` is divided.
pub(crate) fn end_of_runs<T>(sorted: &[T], from: usize, same: impl Fn(&T, &T) -> bool) -> usize {
    let mut end = (from + LIGHT_PIECE).min(sorted.len());
    while end > from && end < sorted.len() && same(&sorted[end - 1], &sorted[end]) {
        end += 1;
    }
    end
}
