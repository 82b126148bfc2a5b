//! Drops faces that repeat another one.

use super::face::Face;

/// Drops every face that has the vertices and the winding of an earlier one. Returns the number of faces dropped.
pub(super) fn drop_duplicates(faces: &mut Vec<Face>) -> usize {
    let mut order: Vec<_> = faces.iter().enumerate().map(|(f, face)| (lowest_first(face.vertices), f)).collect();
    order.sort_unstable();
    let mut repeats = vec![false; faces.len()];
    for pair in order.windows(2) {
        repeats[pair[1].1] = pair[0].0 == pair[1].0;
    }
    let before = faces.len();
    let mut repeats = repeats.into_iter();
    faces.retain(|_| !repeats.next().unwrap_or(false));
    before - faces.len()
}

/// Returns the same cycle of vertices, starting at the lowest.
fn lowest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
