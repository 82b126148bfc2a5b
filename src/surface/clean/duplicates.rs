//! Drops faces that repeat another one.

use std::collections::BTreeMap;

use super::face::Face;
use crate::rest::{Rest, sort_by_number};

/// Drops every face that has the vertices and the winding of an earlier one. Returns the number of faces dropped.
///
/// Fillers (`is_filler`: faces with next to no area) may also come to lie on each other by welding. Then they are no
/// copies, but each closes the surface at its edges, and an even number of them closes nothing: the faces around them
/// meet without any. So the first of an even number goes, too, where that leaves fewer edges with an odd number of
/// faces.
pub(super) async fn drop_duplicates(
    faces: &mut Vec<Face>,
    is_filler: impl Fn(&Face) -> bool + Send + Sync,
    rest: &mut impl Rest,
) -> usize {
    let order: Vec<_> = faces.iter().enumerate().map(|(f, face)| (lowest_first(face.vertices), f)).collect();
    rest.rest().await;
    let order = sort_by_number(order, |&([lowest, ..], _)| lowest, rest).await;
    let mut repeats = vec![false; faces.len()];
    let mut pairs = Vec::new();
    for run in order.chunk_by(|a, b| a.0 == b.0) {
        run[1..].iter().for_each(|&(_, f)| repeats[f] = true);
        if run.len() % 2 == 0 && is_filler(&faces[run[0].1]) {
            pairs.push(run[0].1);
        }
    }
    rest.rest().await;
    drop_pairs(faces, &pairs, &mut repeats);
    let before = faces.len();
    let mut repeats = repeats.into_iter();
    faces.retain(|_| !repeats.next().unwrap_or(false));
    before - faces.len()
}

/// Marks those of the faces `pairs` that are better dropped along with their copies.
fn drop_pairs(faces: &[Face], pairs: &[usize], repeats: &mut [bool]) {
    // Edges of the pairs, and whether an odd number of faces is left at them.
    let mut is_odd: BTreeMap<[u32; 2], bool> =
        pairs.iter().flat_map(|&f| edges(faces[f].vertices)).map(|edge| (edge, false)).collect();
    if is_odd.is_empty() {
        return;
    }
    for (face, _) in faces.iter().zip(&*repeats).filter(|(_, repeats)| !**repeats) {
        edges(face.vertices).into_iter().for_each(|edge| turn(edge, &mut is_odd));
    }
    for &f in pairs {
        let edges = edges(faces[f].vertices);
        if edges.iter().filter(|edge| is_odd[*edge]).count() >= 2 {
            repeats[f] = true;
            edges.into_iter().for_each(|edge| turn(edge, &mut is_odd));
        }
    }
}

fn turn(edge: [u32; 2], is_odd: &mut BTreeMap<[u32; 2], bool>) {
    is_odd.entry(edge).and_modify(|odd| *odd = !*odd);
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
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
