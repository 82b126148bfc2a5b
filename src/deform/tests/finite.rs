//! The plain constraints and what follows a solve keep finite points finite, whatever their sizes.

use bevy_math::Vec3;

use super::draw::Draw;
use crate::{
    deform::{
        BendConstraint, FilmConstraints,
        bend::{bend_corrections, shape_at_rest},
        half_space::above_plane,
        length::length_corrections,
        rigid, update_constraints,
    },
    film::{FilmChanges, HalfEdgeId, LoosePieces, PieceScratch, signed_dihedral},
};

const TRIES: u32 = 300_000;

#[test]
fn plain_constraints_keep_every_finite_point_finite() {
    let mut draw = Draw(1);
    for i in 0..TRIES {
        let p = draw.pair();
        let w = [(); 4].map(|()| draw.below(2) as f32);
        let rest = if draw.below(2) == 0 { draw.pair() } else { p };
        let (skews, medians) = shape_at_rest(rest);
        assert!(skews.iter().all(|skew| skew.is_finite()), "{i}: skews {skews:?} of {rest:?}");
        let start = signed_dihedral(rest[0], rest[1], rest[2], rest[3]);
        assert!(start.is_none_or(f32::is_finite), "{i}: dihedral {start:?} of {rest:?}");
        let mut bend = BendConstraint::new(HalfEdgeId(0), [0, 1, 2, 3], rest, start.unwrap_or(3.0));
        bend.narrow(draw.size(), 3.0 * draw.share());
        let reach = if draw.below(2) == 0 { bend.reach } else { [2.0 * draw.share(), 2.0 * draw.share()] };
        if let Some(d) = bend_corrections(p, w, reach, medians.map(|m| m.min(f32::MAX))) {
            assert!((0..4).all(|k| (p[k] + d[k]).is_finite()), "{i}: {d:?} for {p:?}, {w:?}, {reach:?}, {medians:?}");
        }
        let length = draw.size();
        if let Some(d) = length_corrections([p[0], p[1]], [w[0], w[1]], length) {
            assert!((0..2).all(|k| (p[k] + d[k]).is_finite()), "{i}: {d:?} for {p:?} at rest {length}");
        }
        let normal = draw.along().normalize_or_zero();
        assert!(above_plane(p[0], p[1], normal).is_finite(), "{i}: {p:?} over {normal}");
    }
}

#[test]
fn loose_pieces_of_any_size_are_put_back_to_finite_places() {
    let mut draw = Draw(2);
    let film = super::disk(2);
    let mut loose = LoosePieces::default();
    loose.find(&film.topology, &mut PieceScratch::default(), |_| false);
    let mut constraints = FilmConstraints::new(&film);
    let changes = FilmChanges { separated: film.topology.all_vertices().collect(), ..FilmChanges::default() };
    update_constraints(&film, &mut constraints, &changes);
    let mut before = Vec::new();
    for i in 0..20_000 {
        let mut mesh = film.clone();
        // A millionth to a million times a mean edge; squares of squares of it leave the range of floats.
        let (size, moved) = (draw.size().clamp(1e-25, 1e8), draw.size().clamp(1e-25, 1e8));
        mesh.geometry.positions.iter_mut().for_each(|p| *p *= size);
        rigid::remember(&mesh.geometry.positions, &loose, constraints.points(), &mut before);
        mesh.geometry.positions.iter_mut().for_each(|p| *p += draw.along() * moved);
        rigid::put_back(&mut mesh.geometry, &loose, constraints.points_mut(), &before);
        let place = mesh.geometry.positions.iter().position(|p| !p.is_finite());
        assert_eq!(place, None, "{i}: size {size}, moved {moved}");
        for v in 0..mesh.geometry.positions.len() {
            constraints.points_mut().put(v, Vec3::ZERO, Vec3::ZERO);
        }
    }
}
