//! Shares a budget of triangles between the films of one prop.

/// Fewest triangles of a film, however small its share of the surface is.
pub const LEAST_TRIANGLES: u32 = 12;

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
