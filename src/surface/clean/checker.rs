//! Checks every promise of a clean surface, without any of the code that makes one.

use std::collections::{BTreeMap, BTreeSet};

use bevy_math::Vec3;

use super::clean_surface::CleanSurface;
use crate::surface::prop_surface::Surface;

/// Checks every promise, and panics with the one that is broken.
pub(super) fn check(surface: &Surface, clean: &CleanSurface) {
    let count = clean.triangles.len();
    assert!(count > 0);
    assert_eq!([clean.corners.len(), clean.sites.len(), clean.source.len(), clean.flipped.len()], [count; 4]);

    let used: BTreeSet<u32> = clean.triangles.iter().flatten().copied().collect();
    assert!(used.iter().copied().eq(0..clean.positions.len() as u32), "every vertex is used, none is out of range");

    let mut directed = BTreeMap::new();
    for (f, &[a, b, c]) in clean.triangles.iter().enumerate() {
        assert!(a != b && b != c && c != a, "face {f} repeats a vertex");
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let twice = directed.insert((from, to), f);
            assert!(twice.is_none(), "faces {f} and {twice:?} both run from {from} to {to}");
        }
    }

    // Walk each vertex's faces across shared edges: all must be reached from the first.
    let mut faces_at: BTreeMap<u32, BTreeSet<usize>> = BTreeMap::new();
    for (f, triangle) in clean.triangles.iter().enumerate() {
        for &v in triangle {
            faces_at.entry(v).or_default().insert(f);
        }
    }
    for (v, faces) in &faces_at {
        let mut reached = BTreeSet::new();
        let mut open = vec![*faces.first().unwrap()];
        while let Some(f) = open.pop() {
            if reached.insert(f) {
                for w in clean.triangles[f].into_iter().filter(|w| w != v) {
                    open.extend([(*v, w), (w, *v)].iter().filter_map(|edge| directed.get(edge)));
                }
            }
        }
        assert_eq!(reached.len(), faces.len(), "vertex {v} has several fans");
    }

    check_sites(surface, clean);
}

fn check_sites(surface: &Surface, clean: &CleanSurface) {
    let size = surface.triangles.iter().flatten().map(|v| surface.positions[*v as usize].length()).fold(0.0, f32::max);
    for (f, sites) in clean.sites.iter().enumerate() {
        for (k, site) in sites.iter().enumerate() {
            assert_eq!(site.triangle, clean.source[f]);
            assert!((site.weights.element_sum() - 1.0).abs() < 1e-5 && site.weights.min_element() >= 0.0);
            let corners = surface.triangles[site.triangle as usize].map(|v| surface.positions[v as usize]);
            let place: Vec3 = (0..3).map(|i| corners[i] * site.weights[i]).sum();
            let vertex = clean.positions[clean.triangles[f][k] as usize];
            assert!(place.distance(vertex) <= 1e-4 * size, "face {f} corner {k}: site {place}, vertex {vertex}");

            let corner = clean.corners[f][k] as usize;
            let corner_at = surface.positions[surface.triangles[corner / 3][corner % 3] as usize];
            assert!(corner_at.distance(vertex) <= 1e-4 * size, "face {f} corner {k} is not at its surface corner");
        }
    }
}

/// Returns the Euler characteristic and the number of border edges.
pub(super) fn euler_and_borders(triangles: &[[u32; 3]], vertices: usize) -> (i64, usize) {
    let mut edges: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            *edges.entry((a.min(b), a.max(b))).or_default() += 1;
        }
    }
    let euler = vertices as i64 - edges.len() as i64 + triangles.len() as i64;
    (euler, edges.values().filter(|faces| **faces == 1).count())
}

/// Returns the number of shells: components over shared vertices.
pub(super) fn shells(clean: &CleanSurface) -> usize {
    let mut label: Vec<u32> = (0..clean.positions.len() as u32).collect();
    loop {
        let mut changed = false;
        for triangle in &clean.triangles {
            let low = triangle.iter().map(|v| label[*v as usize]).min().unwrap();
            for v in triangle {
                changed |= std::mem::replace(&mut label[*v as usize], low) != low;
            }
        }
        if !changed {
            return label.iter().collect::<BTreeSet<_>>().len();
        }
    }
}
