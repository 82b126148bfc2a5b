//! Finds the target of each film of a coating, and shares triangles between them.

use super::{
    resolution::{FilmResolution, GRAIN_SHARES},
    target::{FilmTarget, count_of_edge},
};

/// Fewest triangles of a film, however small its share of the surface is.
pub const LEAST_TRIANGLES: u32 = 12;

/// Fewest triangles of all films of a coating together whose edges follow the grain: small props need them to keep
/// their shape.
const LEAST_GRAIN_TRIANGLES: u32 = 1000;

/// Returns the triangles of each film, out of `budget` triangles that are shared in proportion to `areas`. Films whose
/// share would be less than [`LEAST_TRIANGLES`] get that many; the others share the rest. One film alone gets the whole
/// budget. Areas that are negative or NaN count as 0.
///
/// ```
/// use bevy_coating::remesh::share_triangles;
///
/// assert_eq!(share_triangles(4000, &[3.0, 1.0]), [3000, 1000]);
/// assert_eq!(share_triangles(4000, &[3.0]), [4000]);
/// ```
pub fn share_triangles(budget: u32, areas: &[f64]) -> Vec<u32> {
    if let [_] = areas {
        return vec![budget];
    }
    let least = f64::from(LEAST_TRIANGLES);
    // From the smallest to the largest: whoever is below the minimum takes it out of what the larger ones share.
    let mut order: Vec<usize> = (0..areas.len()).collect();
    let area = |i: usize| if areas[i] > 0.0 { areas[i] } else { 0.0 };
    order.sort_by(|&a, &b| area(a).total_cmp(&area(b)));
    let mut rest = f64::from(budget);
    let mut whole: f64 = order.iter().map(|&i| area(i)).sum();
    let mut shares = vec![LEAST_TRIANGLES; areas.len()];
    for (k, &i) in order.iter().enumerate() {
        let part = |own: f64| if whole > 0.0 { rest.max(0.0) * own / whole } else { 0.0 };
        if part(area(i)) >= least {
            for &i in &order[k..] {
                shares[i] = part(area(i)).round() as u32;
            }
            break;
        }
        rest -= least;
        whole -= area(i);
    }
    shares
}

/// Returns the target of each film of a coating that asks for `resolution`, given the grain that its settings ask for,
/// in metres, and the area of each film, in square metres. Areas that are negative or NaN count as 0.
///
/// [`FilmResolution::Grain`] becomes an edge length, and where the films would have too many triangles together, each
/// one's share of them. Where they would have fewer than 1,000 together, edges are shorter, down to the
/// least share of the grain that may be asked for. Films have at least [`LEAST_TRIANGLES`] triangles in either case.
/// Resolutions out of their ranges become targets that [`build_film`](super::build_film) refuses.
///
/// ```
/// use bevy_coating::remesh::{FilmResolution, FilmTarget, film_targets};
///
/// let resolution = FilmResolution::Grain { share: 0.5, max_triangles: 4000 };
/// // A square metre in edges of 5 cm takes 924 triangles, and in edges of 2 cm 5,774.
/// assert_eq!(film_targets(resolution, 0.1, &[2.0]), [FilmTarget::EdgeLength(0.05)]);
/// assert_eq!(film_targets(resolution, 0.04, &[0.75, 0.25]), [3000, 1000].map(FilmTarget::Triangles));
/// ```
pub fn film_targets(resolution: FilmResolution, grain: f32, areas: &[f64]) -> Vec<FilmTarget> {
    let shared = |budget| {
        let shares = share_triangles(budget, areas).into_iter();
        // A budget that cannot be met is told as such, not as the least share of it.
        shares.map(|share| FilmTarget::Triangles(if budget < 4 { budget } else { share })).collect()
    };
    match resolution {
        FilmResolution::Grain { share, max_triangles } => {
            let least = f64::from(LEAST_TRIANGLES);
            let edge = finer_edge(share, grain, max_triangles.min(LEAST_GRAIN_TRIANGLES), areas);
            // Neither a negative area nor NaN is above the least.
            let count = |&area: &f64| count_of_edge(area, edge).max(least);
            if areas.iter().map(count).sum::<f64>() > f64::from(max_triangles) || max_triangles < 4 {
                return shared(max_triangles);
            }
            let few = |area| count(area) <= least;
            let target =
                |area| if few(area) { FilmTarget::Triangles(LEAST_TRIANGLES) } else { FilmTarget::EdgeLength(edge) };
            areas.iter().map(target).collect()
        }
        FilmResolution::Triangles(budget) => shared(budget),
        FilmResolution::EdgeLength(length) => vec![FilmTarget::EdgeLength(length); areas.len()],
        FilmResolution::Keep => vec![FilmTarget::Keep; areas.len()],
    }
}

/// Returns an edge of `share` grains, or a shorter one with which all of `areas` take `least` triangles.
fn finer_edge(share: f32, grain: f32, least: u32, areas: &[f64]) -> f32 {
    let edge = share * grain;
    let area: f64 = areas.iter().filter(|&&area| area > 0.0).sum();
    let count = count_of_edge(area, edge);
    if !(count > 0.0 && count < f64::from(least)) {
        return edge;
    }
    let shorter = edge * (count / f64::from(least)).sqrt() as f32;
    shorter.max(GRAIN_SHARES.start() * grain).min(edge)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAIN: FilmResolution = FilmResolution::Grain { share: 0.5, max_triangles: 2000 };

    #[test]
    fn the_budget_is_shared_by_area_with_a_minimum() {
        assert_eq!(share_triangles(4000, &[2.0]), [4000]);
        assert_eq!(share_triangles(1000, &[3.0, 1.0]), [750, 250]);
        assert_eq!(share_triangles(1000, &[1.0, 1e-9]), [988, LEAST_TRIANGLES]);
        assert_eq!(share_triangles(4, &[1.0, 1.0]), [LEAST_TRIANGLES; 2]);
        assert_eq!(share_triangles(100, &[0.0, 0.0]), [LEAST_TRIANGLES; 2]);
        assert_eq!(share_triangles(1000, &[f64::NAN, 1.0, -3.0]), [LEAST_TRIANGLES, 976, LEAST_TRIANGLES]);
        assert_eq!(share_triangles(1000, &[]), [0; 0]);
    }

    #[test]
    fn shares_add_up_to_the_budget() {
        let areas: Vec<f64> = (0..200).map(|i| if i % 3 == 0 { 1e-6 } else { f64::from(i) }).collect();
        let shares = share_triangles(40_000, &areas);
        let sum: u32 = shares.iter().sum();
        assert!(sum.abs_diff(40_000) <= 100, "{sum}");
        assert!(shares.iter().all(|&share| share >= LEAST_TRIANGLES));
    }

    #[test]
    fn the_edge_follows_the_grain_up_to_the_budget() {
        // 0.5 x 0.1 m: 924 triangles a square metre.
        assert_eq!(film_targets(GRAIN, 0.1, &[1.0, 0.5]), [FilmTarget::EdgeLength(0.05); 2]);
        assert_eq!(film_targets(GRAIN, 0.1, &[1.2, 1.2]), [FilmTarget::Triangles(1000); 2]);
        assert_eq!(film_targets(GRAIN, 0.01, &[7.0]), [FilmTarget::Triangles(2000)]);
        assert_eq!(film_targets(GRAIN, 0.1, &[]), []);
    }

    #[test]
    fn small_props_have_shorter_edges() {
        // A bottle of a hundredth of a square metre, in edges of 5 cm, would be a dozen triangles.
        let [FilmTarget::EdgeLength(edge)] = film_targets(FilmResolution::default(), 0.04, &[0.05])[..] else {
            panic!("an edge length");
        };
        let count = count_of_edge(0.05, edge);
        assert!((count - 1000.0).abs() < 1.0 && edge < 0.028, "{count} of {edge} m");
        // A tenth of the grain is the least.
        let targets = film_targets(FilmResolution::default(), 0.04, &[0.003]);
        assert_eq!(targets, [FilmTarget::EdgeLength(0.004)]);
        // Whoever asks for fewer gets fewer.
        let few = FilmResolution::Grain { share: 0.7, max_triangles: 200 };
        assert_eq!(film_targets(few, 0.04, &[0.05]), [FilmTarget::EdgeLength(edge * 5.0_f32.sqrt())]);
    }

    #[test]
    fn small_films_have_the_least_number_of_triangles() {
        let targets = film_targets(GRAIN, 0.1, &[1.5, 1e-4, f64::NAN, -1.0]);
        let least = FilmTarget::Triangles(LEAST_TRIANGLES);
        assert_eq!(targets, [FilmTarget::EdgeLength(0.05), least, least, least]);
        // A hundred bolts exceed the budget by themselves.
        assert_eq!(film_targets(GRAIN, 0.1, &[1e-4; 100]), vec![least; 100]);
    }

    #[test]
    fn other_resolutions_know_no_grain() {
        for grain in [0.01, 1.0, f32::NAN] {
            let of = |resolution| film_targets(resolution, grain, &[3.0, 1.0]);
            assert_eq!(of(FilmResolution::Triangles(4000)), [3000, 1000].map(FilmTarget::Triangles));
            assert_eq!(of(FilmResolution::EdgeLength(0.1)), [FilmTarget::EdgeLength(0.1); 2]);
            assert_eq!(of(FilmResolution::Keep), [FilmTarget::Keep; 2]);
        }
    }

    #[test]
    fn what_is_out_of_range_becomes_a_target_that_is_refused() {
        let refused = [
            FilmResolution::Triangles(3),
            FilmResolution::EdgeLength(f32::NAN),
            FilmResolution::Grain { share: 0.7, max_triangles: 3 },
            FilmResolution::Grain { share: f32::NAN, max_triangles: 1000 },
            FilmResolution::Grain { share: 0.0, max_triangles: 1000 },
            FilmResolution::Grain { share: -0.7, max_triangles: 1000 },
            FilmResolution::Grain { share: 2.1, max_triangles: 1000 },
        ];
        for resolution in refused {
            assert!(resolution.validate().is_err(), "{resolution:?}");
        }
        for resolution in &refused[..3] {
            let targets = film_targets(*resolution, 0.1, &[1.0, 1.0]);
            assert!(targets.iter().all(|target| target.validate().is_err()), "{targets:?}");
        }
        for share in [0.1, 0.7, 2.0] {
            assert_eq!(FilmResolution::Grain { share, max_triangles: 4 }.validate(), Ok(()));
        }
    }
}
