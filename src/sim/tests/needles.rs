//! Films with triangles as thin as floats allow stay finite, with the same bits on every instruction set.

use bevy_math::Vec3;

use crate::{
    deform::{SimdLevel, SolverQuality},
    film::{FilmMesh, tests::grid},
    settings::{CoatingSettings, Preset},
    sim::state::FilmState,
    stain::Environment,
};

/// A plate, one triangle of which is divided at its centroid `levels` times, each time the newest that keeps its
/// corner `towards`, or that lies between the newest three vertices where there is none.
fn spike(levels: usize, towards: Option<u32>) -> FilmMesh {
    let (mut positions, mut triangles) = grid(6, 6);
    positions.iter_mut().for_each(|p| *p /= 6.0);
    let mut current = towards.map_or(30, |v| triangles.iter().position(|t| t.contains(&v)).unwrap());
    for _ in 0..levels {
        let t = triangles[current];
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let middle = positions.len() as u32;
        positions.push((a + b + c) / 3.0);
        triangles[current] = [t[0], t[1], middle];
        triangles.push([t[1], t[2], middle]);
        triangles.push([t[2], t[0], middle]);
        current = match towards {
            Some(v) if t[0] == v || t[1] == v => current,
            _ => triangles.len() - 1,
        };
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

#[test]
fn films_of_needle_triangles_stay_finite_at_every_quality_and_level() {
    let environment = Environment { rain: Vec3::NEG_Y * 0.5, ..Environment::default() };
    for (case, mesh) in [(0, spike(30, None)), (1, spike(14, Some(0))), (2, spike(60, None)), (3, spike(30, Some(24)))]
    {
        for preset in [Preset::Default, Preset::Heavy] {
            let settings = CoatingSettings::from(preset);
            for quality in SolverQuality::ALL {
                let run = |level| {
                    let mut film = FilmState::from_mesh(mesh.clone(), &settings, case, 300);
                    film.quality = quality;
                    film.scratch.bend.level = level;
                    for step in 0..300 {
                        film.step(&settings, &environment);
                        if let Err(error) = film.validate() {
                            panic!("case {case}, {preset:?}, {quality:?}, {level:?}, step {step}: {error}");
                        }
                    }
                    film.digest()
                };
                let twin = run(SimdLevel::Scalar);
                for level in SimdLevel::ALL.into_iter().filter(|level| level.is_available()) {
                    assert_eq!(run(level), twin, "case {case}, {preset:?}, {quality:?}, {level:?}");
                }
            }
        }
    }
}
