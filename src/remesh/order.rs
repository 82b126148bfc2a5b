//! Numbers the vertices and faces of a film along a curve through space.
//!
//! Remeshing leaves them in the order in which edits made them: neighbours on the film lie anywhere in memory. Each
//! stage walks over a film by its numbers and looks at neighbours, so a film that is larger than the cache would wait
//! for memory all the time. Along a Hilbert curve, what is near on the film is nearly always near in memory.

use bevy_math::DVec3;

use super::film::BuiltFilm;

/// Number of bits of each coordinate along the curve: cells far smaller than the edges of any film.
const BITS: u32 = 20;

/// Returns the same film with its vertices numbered along a Hilbert curve through their positions, and its faces by
/// their lowest vertex. Vertices in one cell of the curve, and faces with the same lowest vertex, keep their order.
pub(super) fn along_curve(film: BuiltFilm) -> BuiltFilm {
    let order = vertex_order(&film);
    let mut numbers = vec![0; order.len()];
    for (number, &v) in order.iter().enumerate() {
        numbers[v as usize] = number as u32;
    }
    let triangles: Vec<[u32; 3]> = film.triangles.iter().map(|t| t.map(|v| numbers[v as usize])).collect();
    let mut faces: Vec<u32> = (0..triangles.len() as u32).collect();
    faces.sort_by_key(|&f| triangles[f as usize].iter().min().copied());
    let all = || faces.iter().map(|&f| f as usize);
    BuiltFilm {
        positions: order.iter().map(|&v| film.positions[v as usize]).collect(),
        triangles: all().map(|f| triangles[f]).collect(),
        slots: all().map(|f| film.slots[f]).collect(),
        flipped: all().map(|f| film.flipped[f]).collect(),
        sites: all().flat_map(|f| [0, 1, 2].map(|corner| film.sites[3 * f + corner])).collect(),
        warnings: film.warnings,
    }
}

/// Returns the vertices in the order of the curve.
fn vertex_order(film: &BuiltFilm) -> Vec<u32> {
    let points = || film.positions.iter().map(|p| p.as_dvec3());
    let (low, high) = points().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    let side = (high - low).max_element();
    let scale = if side > 0.0 { f64::from((1u32 << BITS) - 1) / side } else { 0.0 };
    let keys: Vec<u64> = points().map(|p| hilbert(((p - low) * scale).to_array().map(|x| x as u32))).collect();
    let mut order: Vec<u32> = (0..keys.len() as u32).collect();
    order.sort_by_key(|&v| keys[v as usize]);
    order
}

/// Returns the place along the Hilbert curve of the cell with these coordinates, each below 2 to the power of
/// [`BITS`] (Skilling, "Programming the Hilbert curve", 2004).
fn hilbert(mut x: [u32; 3]) -> u64 {
    // From the largest cubes to the smallest, each is turned as the curve runs through it.
    for bit in (1..BITS).rev() {
        let below = (1u32 << bit) - 1;
        for i in 0..3 {
            if x[i] >> bit & 1 == 1 {
                x[0] ^= below;
            } else {
                let differing = (x[0] ^ x[i]) & below;
                x[0] ^= differing;
                x[i] ^= differing;
            }
        }
    }
    // Gray code.
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut turn = 0;
    for bit in (1..BITS).rev() {
        if x[2] >> bit & 1 == 1 {
            turn ^= (1u32 << bit) - 1;
        }
    }
    // The bits of the coordinates by turns.
    (0..BITS).rev().fold(0, |key, bit| x.iter().fold(key, |key, x| key << 1 | u64::from((x ^ turn) >> bit & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        remesh::{FilmTarget, build_film},
        surface::Surface,
    };
    use bevy_math::Vec3;

    #[test]
    fn the_curve_steps_from_each_cell_to_one_beside_it() {
        // Of the smallest cells at the origin, which the curve fills before it goes elsewhere.
        let mut cells: Vec<[u32; 3]> = (0..4096u32).map(|i| [i & 15, i >> 4 & 15, i >> 8]).collect();
        cells.sort_by_key(|&cell| hilbert(cell));
        assert!(cells.iter().enumerate().all(|(i, &cell)| hilbert(cell) == i as u64));
        for pair in cells.windows(2) {
            let step: u32 = (0..3).map(|i| pair[0][i].abs_diff(pair[1][i])).sum();
            assert_eq!(step, 1, "{pair:?}");
        }
    }

    fn square(triangles: u32) -> BuiltFilm {
        let square = Surface {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            slots: vec![3, 4],
            ..Surface::default()
        };
        build_film(&square, FilmTarget::Triangles(triangles), 7).expect("a film")
    }

    #[test]
    fn neighbours_on_remeshed_films_are_near_in_memory() {
        let film = square(10_000);
        let faces = film.triangles.len() as f32;
        let spans = film.triangles.iter().map(|t| t.iter().max().unwrap() - t.iter().min().unwrap());
        let mut spans: Vec<u32> = spans.collect();
        spans.sort_unstable();
        // In the order of edits half of the faces would span more than a fifth of all vertices.
        assert!(spans[spans.len() / 2] < 40, "{}", spans[spans.len() / 2]);
        let middle = |t: &[u32; 3]| t.iter().map(|&v| film.positions[v as usize]).sum::<Vec3>() / 3.0;
        let steps = film.triangles.windows(2).map(|t| middle(&t[0]).distance(middle(&t[1])));
        let mean = steps.sum::<f32>() / faces;
        assert!(mean < 0.02, "{mean}");
    }

    #[test]
    fn all_of_a_face_follows_it() {
        let film = square(300);
        let order: Vec<u32> = (0..film.positions.len() as u32).rev().collect();
        let turned = BuiltFilm {
            positions: order.iter().map(|&v| film.positions[v as usize]).collect(),
            triangles: film.triangles.iter().rev().map(|t| t.map(|v| order[v as usize])).collect(),
            slots: film.slots.iter().rev().copied().collect(),
            flipped: (0..film.triangles.len()).map(|f| f % 3 == 0).collect(),
            sites: film.sites.chunks(3).rev().flatten().copied().collect(),
            warnings: Vec::new(),
        };
        let again = along_curve(turned.clone());
        assert_eq!(again.positions, film.positions);
        let whole = |film: &BuiltFilm| {
            let mut faces: Vec<_> = (0..film.triangles.len())
                .map(|f| {
                    let corners = film.triangles[f].map(|v| film.positions[v as usize].to_array().map(f32::to_bits));
                    let sites = &film.sites[3 * f..3 * f + 3];
                    let sites: Vec<_> =
                        sites.iter().map(|s| (s.triangle, s.weights.to_array().map(f32::to_bits))).collect();
                    (corners, film.slots[f], film.flipped[f], sites)
                })
                .collect();
            faces.sort();
            faces
        };
        assert_eq!(whole(&again), whole(&turned));
        assert!(again.triangles.iter().map(|t| t.iter().min()).is_sorted());
        assert!(along_curve(BuiltFilm::default()).triangles.is_empty());
    }
}
