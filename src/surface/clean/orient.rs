//! Unifies the winding of each shell.

use bevy_math::Vec3;

use super::face::{Face, NONE};
use crate::rest::{LIGHT_PIECE, Rest};

/// Turns faces until all twins of a shell run in opposite directions. The winding of the larger area is kept. On a
/// one-sided shell some twins cannot agree; they are parted. Returns the number of edges parted.
pub(super) async fn unify(faces: &mut [Face], twin: &mut [u32], positions: &[Vec3], rest: &mut impl Rest) -> usize {
    let starts = faces.iter().flat_map(|face| face.vertices).collect();
    let mut walk = Walk { faces, twin, positions, starts, turned: vec![None; faces.len()], cuts: 0 };
    let mut shell = Vec::new();
    let mut since_rest = 0;
    for seed in 0..faces.len() {
        if walk.turned[seed].is_some() {
            continue;
        }
        walk.turned[seed] = Some(false);
        shell.clear();
        shell.push(seed);
        let mut area = [0.0; 2];
        let mut met = 0;
        while met < shell.len() {
            let begin = met;
            while met < shell.len() && since_rest + met - begin < LIGHT_PIECE {
                let f = shell[met];
                met += 1;
                walk.meet(f, &mut shell, &mut area);
            }
            since_rest += met - begin;
            if since_rest >= LIGHT_PIECE {
                since_rest = 0;
                rest.rest().await;
            }
        }
        if area[1] > area[0] {
            for &f in &shell {
                walk.turned[f] = walk.turned[f].map(|turned| !turned);
            }
        }
    }

    let Walk { turned, cuts, .. } = walk;
    let turned: Vec<bool> = turned.into_iter().map(|turned| turned == Some(true)).collect();
    for (face, _) in faces.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        face.turn();
    }
    rest.rest().await;
    // Turning a face swaps its half-edges 0 and 2.
    let renamed = |h: usize| if turned[h / 3] { h / 3 * 3 + (2 - h % 3) } else { h };
    let before = twin.to_vec();
    for (h, &g) in before.iter().enumerate() {
        twin[renamed(h)] = if g == NONE { NONE } else { renamed(g as usize) as u32 };
    }
    rest.rest().await;
    cuts
}

/// Walk over the faces of all shells.
struct Walk<'a> {
    faces: &'a [Face],
    twin: &'a mut [u32],
    positions: &'a [Vec3],
    /// Vertex at which each half-edge starts.
    starts: Vec<u32>,
    /// Whether each face runs against the winding of the first face of its shell; `None` until it is visited.
    turned: Vec<Option<bool>>,
    /// Number of edges parted.
    cuts: usize,
}

impl Walk<'_> {
    /// Adds the area of the face `f` to that of its winding, and its neighbours to the shell.
    fn meet(&mut self, f: usize, shell: &mut Vec<usize>, area: &mut [f64; 2]) {
        let Self { faces, twin, positions, starts, turned, cuts } = self;
        let against = turned[f] == Some(true);
        let [a, b, c] = faces[f].points(positions);
        area[usize::from(against)] += (b - a).cross(c - a).length();
        for h in 3 * f..3 * f + 3 {
            let g = twin[h];
            if g == NONE {
                continue;
            }
            let neighbour = g as usize / 3;
            let wanted = against ^ (starts[h] == starts[g as usize]);
            match turned[neighbour] {
                None => {
                    turned[neighbour] = Some(wanted);
                    shell.push(neighbour);
                }
                Some(is) if is != wanted => {
                    (twin[h], twin[g as usize]) = (NONE, NONE);
                    *cuts += 1;
                }
                Some(_) => {}
            }
        }
    }
}
