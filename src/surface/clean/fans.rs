//! Splits vertices until the faces of each form one fan.

use bevy_math::Vec3;

use super::face::{Face, NONE};
use super::pair::{Edges, is_same_edge, next_edges, sorted_half_edges};
use crate::rest::{LIGHT_PIECE, Rest, pieces};

/// Gives every fan but the first of each vertex a duplicate of the vertex, so that the twins are exactly the edges with
/// two faces. Returns the number of vertices at which fans met in a point: those that lie on no edge with more than two
/// faces.
pub(super) async fn split(
    faces: &mut [Face],
    twin: &mut [u32],
    positions: &mut Vec<Vec3>,
    edges: &Edges,
    rest: &mut impl Rest,
) -> usize {
    let welded = positions.len();
    let original: Vec<u32> = faces.iter().flat_map(|face| face.vertices).collect();
    loop {
        positions.truncate(welded);
        name_fans(faces, twin, &original, positions, rest).await;
        // Faces that were not paired at an edge may still share both its vertices, through fans that lead
        // around them. Parting all twins of such an edge opens those fans, which adds vertices, so this ends.
        if !settle_shared_edges(faces, twin, rest).await {
            break;
        }
    }

    let mut on_split_edge = vec![false; welded];
    for (a, b) in edges.non_manifold_edges() {
        on_split_edge[a as usize] = true;
        on_split_edge[b as usize] = true;
    }
    let mut several = vec![false; welded];
    for (corner, &v) in original.iter().enumerate() {
        several[v as usize] |= faces[corner / 3].vertices[corner % 3] != v;
    }
    several.iter().zip(&on_split_edge).filter(|(several, on_split_edge)| **several && !**on_split_edge).count()
}

/// Joins corners across twins to fans. The fan with the lowest corner keeps the vertex; the others get duplicates.
async fn name_fans(
    faces: &mut [Face],
    twin: &[u32],
    original: &[u32],
    positions: &mut Vec<Vec3>,
    rest: &mut impl Rest,
) {
    let mut parent: Vec<u32> = (0..original.len() as u32).collect();
    for half_edges in pieces(twin.len(), LIGHT_PIECE) {
        for h in half_edges {
            let g = twin[h];
            if g != NONE && h < g as usize {
                join(&mut parent, h as u32, next(g));
                join(&mut parent, next(h as u32), g);
            }
        }
        rest.rest().await;
    }
    let mut taken = vec![false; positions.len()];
    let mut name = vec![NONE; original.len()];
    for corners in pieces(original.len(), LIGHT_PIECE) {
        for corner in corners {
            // Roots are the lowest corners of their fans, so they are named first.
            let root = find(&mut parent, corner as u32) as usize;
            if root == corner {
                let v = original[corner] as usize;
                if taken[v] {
                    positions.push(positions[v]);
                    name[corner] = positions.len() as u32 - 1;
                } else {
                    taken[v] = true;
                    name[corner] = v as u32;
                }
            }
            faces[corner / 3].vertices[corner % 3] = name[root];
        }
        rest.rest().await;
    }
}

/// Makes twins of two half-edges that are the only ones between their two vertices, and parts all twins where there are
/// more than two. Returns whether any twins were parted.
async fn settle_shared_edges(faces: &[Face], twin: &mut [u32], rest: &mut impl Rest) -> bool {
    let half_edges = sorted_half_edges(faces, |face| face.vertices, rest).await;
    let (mut parted, mut from) = (false, 0);
    while let Some(piece) = next_edges(&half_edges, &mut from) {
        for run in piece.chunk_by(is_same_edge) {
            match *run {
                [_] => {}
                // Both ends of the fans at both vertices: the fans close. Within a fan windings agree already.
                [(_, g), (_, h)] => (twin[g as usize], twin[h as usize]) = (h, g),
                _ => {
                    for &(_, h) in run {
                        parted |= twin[h as usize] != NONE;
                        twin[h as usize] = NONE;
                    }
                }
            }
        }
        rest.rest().await;
    }
    parted
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

fn find(parent: &mut [u32], mut corner: u32) -> u32 {
    while parent[corner as usize] != corner {
        let up = parent[parent[corner as usize] as usize];
        parent[corner as usize] = up;
        corner = up;
    }
    corner
}

fn join(parent: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(parent, a), find(parent, b));
    parent[a.max(b) as usize] = a.min(b);
}
