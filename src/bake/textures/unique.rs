//! Tells whether the prop's own texture coordinates can hold stains: each place of the surface needs texels of its own.

use bevy_math::Vec2;

use super::coverage::count_overlaps;
use crate::{appearance::CornerAttributes, bake::coat::Prop, sim::FilmState};

/// How far coordinates may leave the texture, in its sides.
const OUTSIDE: f32 = 1e-3;
/// Share of the covered samples that may lie on several faces.
const OVERLAP: f32 = 2e-3;
/// Texels that a face must have in the mean.
const TEXELS_A_FACE: f32 = 6.0;
/// How much coarser than the mean texels may be on a face, along a side.
const COARSER: f32 = 4.0;
/// Share of the surface that may be coarser.
const COARSE_AREA: f32 = 0.02;

/// Finds which of the prop's slots have first texture coordinates that are unique over the whole film of the slot, lie
/// in the texture, and give every face its share of `size` by `size` texels. Does not depend on the age.
pub fn unique_slots(prop: &Prop, film: &FilmState, size: u32) -> Vec<bool> {
    let corners = CornerAttributes::sample(&prop.built, &prop.surface, &film.mesh);
    let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
    let check = |slot: usize| {
        let faces =
            topology.all_faces().filter(|f| prop.built.slots.get(f.index()).copied().unwrap_or(0) as usize == slot);
        let mut areas = Vec::new();
        let mut triangles: Vec<[Vec2; 3]> = Vec::new();
        for f in faces {
            let Some(uvs) = corners.uvs.get(f.index() * 3..f.index() * 3 + 3) else { return false };
            triangles.push([uvs[0], uvs[1], uvs[2]]);
            areas.push(geometry.rest_area_of(topology, f));
        }
        is_unique(&triangles, &areas, size)
    };
    prop.slots.iter().enumerate().map(|(i, slot)| slot.uvs && check(i)).collect()
}

/// `areas` are those of the surface.
fn is_unique(triangles: &[[Vec2; 3]], areas: &[f32], size: u32) -> bool {
    let inside = |p: Vec2| p.min_element() >= -OUTSIDE && p.max_element() <= 1.0 + OUTSIDE;
    if triangles.is_empty() || !triangles.iter().flatten().all(|&p| inside(p)) {
        return false;
    }
    let texels: Vec<f32> =
        triangles.iter().map(|[a, b, c]| (b - a).perp_dot(c - a).abs() * 0.5 * (size * size) as f32).collect();
    let (covered, area): (f32, f32) = (texels.iter().sum(), areas.iter().sum());
    if !(covered >= TEXELS_A_FACE * triangles.len() as f32) {
        return false;
    }
    let density = covered / area;
    let coarse: f32 = texels
        .iter()
        .zip(areas)
        .filter(|&(&texels, &area)| texels * COARSER * COARSER < density * area)
        .map(|(_, &area)| area)
        .sum();
    if coarse > COARSE_AREA * area {
        return false;
    }
    let (overlapping, all) = count_overlaps(triangles);
    overlapping as f32 <= OVERLAP * all as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: Vec2, side: f32) -> [[Vec2; 3]; 2] {
        let at = |x: f32, y: f32| low + Vec2::new(x, y) * side;
        [[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
    }

    #[test]
    fn unique_coordinates_lie_apart_in_the_texture_with_texels_for_all() {
        let (a, b) = (square(Vec2::splat(0.1), 0.3), square(Vec2::splat(0.5), 0.3));
        let both = [a, b].concat();
        assert!(is_unique(&both, &[1.0; 4], 256));
        assert!(!is_unique(&[a, a].concat(), &[1.0; 4], 256), "one on the other");
        assert!(!is_unique(&square(Vec2::splat(0.8), 0.3), &[1.0; 2], 256), "outside");
        assert!(!is_unique(&square(Vec2::splat(0.5), 0.001), &[1.0; 2], 256), "a dot in a palette");
        let dot = square(Vec2::splat(0.9), 0.01);
        assert!(!is_unique(&[a, dot].concat(), &[1.0; 4], 256), "one of them is a dot");
        assert!(is_unique(&[a, dot].concat(), &[1.0, 1.0, 1e-3, 1e-3], 256), "that is small itself");
        assert!(!is_unique(&[], &[], 256));
    }
}
