//! Points of the surface at which the film is shown.

use std::f32::consts::TAU;

use bevy_math::{Vec2, Vec3, ops};

use super::{append, bevelled_box, grid, sheet, sphere};
use crate::{
    film::FaceGrid,
    remesh::{BuiltFilm, FilmTarget, FineSites, build_film, fine_sites, sample},
    surface::{BuildError, Surface, SurfaceSite, twins},
};

/// Builds a film and its fine points, and checks what must hold for any.
fn checked(surface: &Surface, target: FilmTarget, level: u32) -> (BuiltFilm, FaceGrid, FineSites) {
    let film = build_film(surface, target, 3).expect("a film");
    let grid = FaceGrid::new(level);
    let fine = check(surface, &film, &grid);
    (film, grid, fine)
}

fn check(surface: &Surface, film: &BuiltFilm, grid: &FaceGrid) -> FineSites {
    let fine = fine_sites(surface, film, grid).expect("fine points");
    let n = grid.points().len();
    assert_eq!((fine.positions.len(), fine.sites.len()), (n * film.triangles.len(), n * film.triangles.len()));
    let along = |f: usize, k: usize| grid.edge(k).iter().map(move |&i| f * n + i as usize);
    for (f, triangle) in film.triangles.iter().enumerate() {
        for (k, &v) in triangle.iter().enumerate() {
            let corner = along(f, k).next().expect("a corner");
            assert_eq!(fine.positions[corner], film.positions[v as usize]);
            assert_eq!(fine.sites[corner], film.sites[3 * f + k]);
        }
    }
    let bits = |i: usize| fine.positions[i].to_array().map(f32::to_bits);
    for (h, &t) in twins(&film.triangles).iter().enumerate().filter(|(_, t)| **t != u32::MAX) {
        let t = t as usize;
        let there: Vec<_> = along(t / 3, t % 3).collect();
        assert!(along(h / 3, h % 3).map(bits).eq(there.into_iter().rev().map(bits)), "edge {h} gapes");
    }
    let size = film.positions.iter().fold(0.0_f32, |size, p| size.max(p.distance(film.positions[0])));
    for (i, site) in fine.sites.iter().enumerate() {
        assert!((site.weights.element_sum() - 1.0).abs() < 1e-4 && site.weights.min_element() > -1e-4);
        let slot = surface.slots.get(site.triangle as usize).copied().unwrap_or_default();
        assert_eq!(slot, film.slots[i / n], "a face lies in two slots");
        assert!(fine.positions[i].distance(place(surface, site)) < 0.3 * size, "point {i} is far from its site");
    }
    fine
}

fn place(surface: &Surface, site: &SurfaceSite) -> Vec3 {
    let [a, b, c] = surface.triangles[site.triangle as usize].map(|v| surface.positions[v as usize]);
    a * site.weights.x + b * site.weights.y + c * site.weights.z
}

/// Largest distance of a point from its site.
fn off_surface(surface: &Surface, fine: &FineSites) -> f32 {
    let distances = fine.positions.iter().zip(&fine.sites).map(|(p, site)| p.distance(place(surface, site)));
    distances.fold(0.0, f32::max)
}

/// Largest value over the points of flat faces and over the fine points.
fn largest(film: &BuiltFilm, grid: &FaceGrid, fine: &FineSites, value: impl Fn(Vec3) -> f32) -> [f32; 2] {
    let flat = film.triangles.iter().flat_map(|t| {
        let [a, b, c] = t.map(|v| film.positions[v as usize]);
        grid.points().iter().map(move |w| a * w.x + b * w.y + c * w.z)
    });
    [flat.map(&value).fold(0.0, f32::max), fine.positions.iter().copied().map(value).fold(0.0, f32::max)]
}

/// A cylinder of radius 1 around z between -1 and 1, with lids and texture if asked for.
fn cylinder(sides: usize, lids: bool) -> Surface {
    let mut surface = Surface::default();
    let round = |u: f32| {
        // The last column is the first, to the bit.
        let (sin, cos) = ops::sin_cos(TAU * u.fract());
        Vec2::new(cos, sin)
    };
    grid(&mut surface, [sides, 40], |p| round(p.x).extend(2.0 * p.y - 1.0), |p| p);
    for z in if lids { &[-1.0_f32, 1.0][..] } else { &[] } {
        grid(&mut surface, [sides, 8], |p| (round(p.x) * (1.0 - p.y)).extend(*z), |p| Vec2::new(p.x + z, p.y + 5.0));
        if *z < 0.0 {
            let from = surface.triangles.len() - 16 * sides;
            surface.triangles[from..].iter_mut().for_each(|t| t.swap(1, 2));
            for corners in surface.uvs[3 * from..].chunks_exact_mut(3) {
                corners.swap(1, 2);
            }
        }
    }
    surface
}

#[test]
fn coarse_films_of_spheres_look_round() {
    let surface = Surface { uvs: Vec::new(), ..sphere(200) };
    let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(300), 2);
    let [flat, round] = largest(&film, &grid, &fine, |p| 1.0 - p.length());
    assert!(round < 1e-3 && flat > 10.0 * round, "{flat} became {round}");
    assert!(off_surface(&surface, &fine) < 1e-4);
}

#[test]
fn coarse_films_of_pipes_look_round() {
    for target in [100, 400] {
        let surface = Surface { uvs: Vec::new(), ..cylinder(256, false) };
        let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(target), 3);
        let [flat, round] = largest(&film, &grid, &fine, |p| (1.0 - p.truncate().length()).abs());
        assert!(round < 1e-3 && flat > 10.0 * round, "{flat} became {round}");
        // The borders stay where they are.
        let [_, far] = largest(&film, &grid, &fine, |p| p.z.abs());
        assert!(far <= 1.0, "{far}");
    }
}

/// The rim is a crease, and the seam of the mantle ends there.
#[test]
fn rims_of_lids_look_round() {
    for textured in [false, true] {
        let mut surface = cylinder(256, true);
        if !textured {
            surface.uvs.clear();
        }
        let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(if textured { 2000 } else { 400 }), 2);
        let is_rim = |v: u32| {
            let p = film.positions[v as usize];
            p.z.abs() > 0.9999 && p.truncate().length() > 0.999
        };
        let mut rim = 0;
        for (f, t) in film.triangles.iter().enumerate() {
            for k in (0..3).filter(|&k| is_rim(t[k]) && is_rim(t[(k + 1) % 3])) {
                for &i in grid.edge(k) {
                    let p = fine.positions[f * grid.points().len() + i as usize];
                    assert!((p.truncate().length() - 1.0).abs() < 1e-3 && p.z.abs() > 0.99999, "{p} is off the rim");
                    rim += 1;
                }
            }
        }
        assert!(rim > 100, "{rim} points");
        assert!(off_surface(&surface, &fine) < 1e-4, "{}", off_surface(&surface, &fine));
    }
}

#[test]
fn films_that_are_kept_stay_flat() {
    let soup = {
        let mut soup = bevelled_box(Vec3::new(2.0, 0.7, 0.5), 0.1, 3);
        append(&mut soup, &sphere(5), Vec3::splat(5.0));
        Surface { positions: soup.positions, triangles: soup.triangles, ..Surface::default() }
    };
    for surface in [sphere(8), sheet(6, 0.3), bevelled_box(Vec3::new(2.0, 0.7, 0.5), 0.1, 3), soup] {
        let (film, grid, fine) = checked(&surface, FilmTarget::Keep, 3);
        for (f, t) in film.triangles.iter().enumerate() {
            let [a, b, c] = t.map(|v| film.positions[v as usize]);
            for (i, w) in grid.points().iter().enumerate() {
                let p = fine.positions[f * grid.points().len() + i];
                assert!(p.distance(a * w.x + b * w.y + c * w.z) < 1e-6 * (1.0 + p.length()));
            }
        }
        assert!(off_surface(&surface, &fine) < 1e-5);
    }
}

#[test]
fn films_finer_than_the_prop_stay_flat() {
    for level in [1, 4] {
        let surface = bevelled_box(Vec3::new(2.0, 0.7, 0.5), 0.1, 3);
        let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(3000), level);
        for (f, t) in film.triangles.iter().enumerate() {
            let [a, b, c] = t.map(|v| film.positions[v as usize]);
            for (i, w) in grid.points().iter().enumerate() {
                let p = fine.positions[f * grid.points().len() + i];
                assert!(p.distance(a * w.x + b * w.y + c * w.z) < 1e-5, "face {f} bulges");
            }
        }
        assert!(off_surface(&surface, &fine) < 1e-4);
    }
}

/// Rivets are smaller than the film's edges, and nothing below them is nearest to their tops.
#[test]
fn small_bumps_stay() {
    for (height, radius) in [(0.03, 0.05), (0.05, 0.05)] {
        let mut surface = Surface::default();
        let bump = |p: Vec2| {
            let from = ((p * 4.0).fract() - 0.5) / 4.0;
            height * (1.0 - from.length_squared() / (radius * radius)).max(0.0).sqrt()
        };
        grid(&mut surface, [200, 200], |p| p.extend(bump(p.min(Vec2::splat(0.9999)))), |p| p);
        let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(200), 3);
        let [_, high] = largest(&film, &grid, &fine, |p| p.z);
        assert!(high > 0.9 * height, "{high} of {height}");
        for x in 0..4 {
            for y in 0..4 {
                let top = (Vec2::new(x as f32, y as f32) + 0.5) / 4.0;
                let [flat, high] =
                    largest(&film, &grid, &fine, |p| if p.truncate().distance(top) < radius { p.z } else { 0.0 });
                assert!(high > 0.75 * height && high >= flat, "a bump has {high} of {height}");
            }
        }
    }
}

#[test]
fn seams_divide_sites() {
    let surface = sphere(40);
    let (film, grid, fine) = checked(&surface, FilmTarget::Triangles(2000), 2);
    let n = grid.points().len();
    for f in 0..film.triangles.len() {
        let range = f * n..(f + 1) * n;
        let u = |site: &SurfaceSite| {
            let t = 3 * site.triangle as usize;
            [0, 1, 2].map(|k| surface.uvs[t + k].x * site.weights[k]).iter().sum::<f32>()
        };
        let (low, high) =
            fine.sites[range.clone()].iter().map(u).fold((f32::MAX, f32::MIN), |(l, h), u| (l.min(u), h.max(u)));
        let poles = fine.positions[range].iter().any(|p| p.z.abs() > 0.9);
        assert!(poles || high - low < 0.25, "face {f} spans {low} to {high}");
    }
}

/// A prop a long way off is worked on where it was built, and its corners keep their bits.
#[test]
fn far_props_have_the_same_points() {
    let near = cylinder(64, true);
    let mut far = near.clone();
    far.positions.iter_mut().for_each(|p| *p += Vec3::new(4096.0, 0.0, 0.0));
    let (film, grid, fine) = checked(&far, FilmTarget::Triangles(1000), 2);
    let [_, off] = largest(&film, &grid, &fine, |p| (p - Vec3::X * 4096.0).truncate().length() - 1.0);
    assert!(off < 2e-3, "{off}");
}

#[test]
fn the_same_film_gives_the_same_points() {
    let surface = cylinder(100, true);
    let [(film, _, a), (_, _, b)] = [(); 2].map(|()| checked(&surface, FilmTarget::Triangles(800), 2));
    assert_eq!(a, b);
    assert_eq!(check(&surface, &film, &FaceGrid::new(0)).positions.len(), 3 * film.triangles.len());
}

#[test]
fn pieces_are_flat_faces() {
    let piece = sample::plate(300, 1).expect("a plate");
    let fine = check(&piece.surface, &piece.film, &FaceGrid::new(2));
    assert!(fine.positions.iter().all(|p| p.z == 0.0));
}

#[test]
fn nonsense_does_no_harm() {
    let surface = cylinder(20, true);
    let grid = FaceGrid::new(2);
    let film = build_film(&surface, FilmTarget::Triangles(300), 1).expect("a film");
    assert_eq!(fine_sites(&surface, &BuiltFilm::default(), &grid), Ok(FineSites::default()));
    assert_eq!(fine_sites(&Surface::default(), &film, &grid), Err(BuildError::NoTriangles));
    let spoil: [&dyn Fn(&mut BuiltFilm); 8] = [
        &|film| film.sites.clear(),
        &|film| film.sites.iter_mut().step_by(7).for_each(|site| site.triangle = u32::MAX),
        &|film| film.sites.iter_mut().step_by(7).for_each(|site| site.weights = Vec3::NAN),
        &|film| film.sites.iter_mut().step_by(3).for_each(|site| site.triangle = (site.triangle * 31) % 900),
        &|film| film.positions.truncate(20),
        &|film| film.positions.iter_mut().step_by(5).for_each(|p| p.y = f32::NAN),
        &|film| film.positions.iter_mut().step_by(5).for_each(|p| *p = Vec3::splat(f32::MAX).copysign(*p)),
        &|film| film.triangles.iter_mut().step_by(3).for_each(|t| *t = [t[0]; 3]),
    ];
    for spoil in spoil {
        let mut film = film.clone();
        spoil(&mut film);
        let fine = fine_sites(&surface, &film, &grid).expect("fine points");
        assert_eq!(fine.positions.len(), film.triangles.len() * grid.points().len());
    }
}
