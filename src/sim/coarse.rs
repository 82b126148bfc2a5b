//! Finds films that are too coarse for their grain.

use crate::{
    film::{FilmMesh, Grain},
    remesh::{FilmResolution, FilmTarget},
    settings::{Rules, ScaleSettings},
    surface::BuildWarning,
};

/// Mean edge of a film that has too few triangles for its grain, in grains, or in those edges that were asked for if
/// they are longer.
const COARSE: f32 = 1.1;
/// Mean edge in grains beyond which a film has a larger grain than is asked for.
const COARSEST: f32 = 2.0;

/// Returns the warning that a film is coarser than the grain that `scale` asks for; `None` if it is not, and by the
/// paper's rules, which have no grain.
///
/// The film was built for `target`, which is what the coating's `resolution` came to. It is too coarse if that is a
/// [`FilmResolution::Grain`] for which there were not triangles enough and its mean edge is more than 1.1 grains, or if
/// its mean edge is more than two grains. Whoever asks for a number of triangles or for edges gets them without a word.
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     remesh::{FilmResolution, FilmTarget, sample},
///     settings::{CoatingSettings, Rules},
///     sim::coarser_than_grain,
/// };
///
/// let mut scale = CoatingSettings::default().scale;
/// scale.rules = Rules::Grain;
/// let plate = sample::plate(200, 7)?.film;
/// let mesh = FilmMesh::new(plate.positions, &plate.triangles).expect("a plate is a manifold");
/// let (resolution, target) = (FilmResolution::Grain { share: 0.7, max_triangles: 200 }, FilmTarget::Triangles(200));
/// let warning = coarser_than_grain(&mesh, resolution, target, &scale);
/// assert!(warning.is_some_and(|warning| warning.to_string().contains("scale.grain")));
/// scale.grain = 0.1;
/// assert_eq!(coarser_than_grain(&mesh, resolution, target, &scale), None);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn coarser_than_grain(
    mesh: &FilmMesh,
    resolution: FilmResolution,
    target: FilmTarget,
    scale: &ScaleSettings,
) -> Option<BuildWarning> {
    if scale.rules != Rules::Grain {
        return None;
    }
    let (asked, edge) = (scale.grain, mesh.geometry.mean_edge);
    let FilmResolution::Grain { share, max_triangles } = resolution else { return None };
    let (share, budget) = match target {
        FilmTarget::Triangles(_) => (Some(share), Some(max_triangles)),
        _ => (None, None),
    };
    let limit = share.map_or(COARSEST, |share| COARSE * share.max(1.0));
    if !(edge > limit * asked) {
        return None;
    }
    // The triangles of all films shrink alike.
    let count = budget.map_or(mesh.topology.face_count() as f64, f64::from);
    let ratio = f64::from(edge) / (f64::from(asked) * f64::from(share.unwrap_or(1.0)));
    let triangles = (count * ratio * ratio).ceil() as u32;
    let grain = Grain::of_film(&mesh.geometry, asked).length;
    Some(BuildWarning::CoarserThanGrain { asked, edge, grain, triangles })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{remesh::sample, settings::CoatingSettings};

    /// Returns edge and grain, in grains asked for, and triangles of the warning about a plate of 800 triangles,
    /// whose grain is asked to be its mean edge over `edges`.
    fn said(edges: f32, (resolution, target): (FilmResolution, FilmTarget)) -> Option<(f32, f32, u32)> {
        let plate = sample::plate(800, 7).expect("a plate").film;
        let mesh = FilmMesh::new(plate.positions, &plate.triangles).expect("a manifold");
        let mut scale = CoatingSettings::default().scale;
        scale.grain = mesh.geometry.mean_edge / edges;
        scale.rules = Rules::Paper;
        assert_eq!(coarser_than_grain(&mesh, resolution, target, &scale), None, "the paper has no grain");
        scale.rules = Rules::Grain;
        match coarser_than_grain(&mesh, resolution, target, &scale)? {
            BuildWarning::CoarserThanGrain { asked, edge, grain, triangles } => {
                assert_eq!((asked, edge), (scale.grain, mesh.geometry.mean_edge));
                Some((edge / asked, grain / asked, triangles))
            }
            other => panic!("{other}"),
        }
    }

    #[test]
    fn who_asks_for_coarse_films_gets_them_without_a_word() {
        assert_eq!(said(4.0, (FilmResolution::Keep, FilmTarget::Keep)), None);
        assert_eq!(said(4.0, (FilmResolution::Triangles(800), FilmTarget::Triangles(800))), None);
        assert_eq!(said(4.0, (FilmResolution::EdgeLength(0.1), FilmTarget::EdgeLength(0.1))), None);
    }

    #[test]
    fn films_that_the_budget_makes_coarse_are_told() {
        let of = |share| FilmResolution::Grain { share, max_triangles: 1600 };
        let bound = |share| (of(share), FilmTarget::Triangles(800));
        assert_eq!(said(1.05, bound(0.7)), None);
        let (edges, grains, _) = said(4.0, bound(0.7)).expect("a warning");
        assert!((edges - 4.0).abs() < 1e-5 && (grains - 2.0).abs() < 1e-5, "{edges} {grains}");
        let (_, grains, triangles) = said(1.4, bound(0.7)).expect("a warning");
        assert_eq!((grains, triangles.abs_diff(4 * 1600) <= 1), (1.0, true), "{triangles}");
        // Where longer edges are asked for than a grain, they are none too long.
        assert_eq!(said(1.6, bound(1.5)), None);
        assert!(said(1.7, bound(1.5)).is_some());
        assert_eq!(said(2.1, bound(2.0)), None);
        // With triangles enough, edges are long because the shape has it so.
        let free = (of(0.7), FilmTarget::EdgeLength(0.1));
        assert_eq!(said(1.4, free), None);
        assert!(said(2.1, free).expect("a warning").2.abs_diff(3528) <= 1);
    }

    #[test]
    fn the_text_names_the_way_out() {
        let mut warning =
            BuildWarning::CoarserThanGrain { asked: 0.028, edge: 0.043_217, grain: 0.028, triangles: 60_000 };
        let text = "its edges are 0.0432 m long in the mean, which is coarse for a grain of 0.028 m; 60000 triangles \
                    would do: ask for as many (or raise `max_triangles` to that), or for a larger `scale.grain`";
        assert_eq!(warning.to_string(), text);
        if let BuildWarning::CoarserThanGrain { grain, .. } = &mut warning {
            *grain = 0.051_234;
        }
        assert!(warning.to_string().contains("grain of 0.028 m, so it has a grain of 0.0512 m; 60000"), "{warning}");
    }
}
