//! Unifies the winding of each shell.

use bevy_math::Vec3;

use super::face::{Face, NONE};

/// Turns faces until all twins of a shell run in opposite directions. The winding of the larger area is kept. On a
/// one-sided shell some twins cannot agree; they are parted. Returns the number of edges parted.
pub(super) fn unify(faces: &mut [Face], twin: &mut [u32], positions: &[Vec3]) -> usize {
    let starts: Vec<u32> = faces.iter().flat_map(|face| face.vertices).collect();
    // Whether each face runs against the winding of the first face of its shell; `None` until it is visited.
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut cuts = 0;
    let mut shell = Vec::new();
    for seed in 0..faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        shell.clear();
        shell.push(seed);
        let mut area = [0.0; 2];
        let mut met = 0;
        while let Some(&f) = shell.get(met) {
            met += 1;
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
                        cuts += 1;
                    }
                    Some(_) => {}
                }
            }
        }
        if area[1] > area[0] {
            for &f in &shell {
                turned[f] = turned[f].map(|turned| !turned);
            }
        }
    }

    let turned: Vec<bool> = turned.into_iter().map(|turned| turned == Some(true)).collect();
    for (face, _) in faces.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
        face.turn();
    }
    // Turning a face swaps its half-edges 0 and 2.
    let renamed = |h: usize| if turned[h / 3] { h / 3 * 3 + (2 - h % 3) } else { h };
    let before = twin.to_vec();
    for (h, &g) in before.iter().enumerate() {
        twin[renamed(h)] = if g == NONE { NONE } else { renamed(g as usize) as u32 };
    }
    cuts
}
