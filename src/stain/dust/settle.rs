//! Lets dust settle on film and open metal (VC 6.2, fig. 11).

use crate::{
    film::{FilmMesh, VertexId},
    settings::DustSettings,
    stain::{environment::Environment, fields::StainFields},
};

/// Lets dust settle on the film and on open metal for a tick of `dt`, an age (VC 6.2, fig. 11).
///
/// At a constant [rate](crate::stain::dust_rate) the clean share of a surface falls exponentially: dust becomes
/// 1 - (1 - dust) exp(-rate `dt`). The film counts in its present shape, so flakes that have turned up gather more. On
/// metal the rate is multiplied by its openness.
///
/// Rates are computed again only where the film has moved or torn, and everywhere after gravity or `settings` have
/// changed.
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     settings::DustSettings,
///     stain::{Environment, StainFields, settle_dust},
/// };
/// use bevy_math::Vec3;
///
/// // A triangle that faces up.
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::Z, Vec3::X], &[[0, 1, 2]])?;
/// let mut stains = StainFields::new(&mesh);
/// let settings = DustSettings::default();
/// settle_dust(&mesh, &mut stains, &settings, &Environment::default(), 0.01);
/// let dust = stains.film.dust[0];
/// assert!((dust - (1.0 - (-settings.rate * 0.01).exp())).abs() < 1e-6);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn settle_dust(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &DustSettings,
    environment: &Environment,
    dt: f32,
) {
    let mut rates = std::mem::take(&mut stains.dust_rates);
    let basis = rates.update(mesh, settings, environment.in_range().gravity, dt);
    if settings.rate > 0.0 {
        for (dust, left) in stains.film.dust.iter_mut().zip(rates.left_on_film()) {
            *dust = 1.0 - (1.0 - *dust) * left;
        }
        if !stains.open.is_empty() {
            // In the order of the arrays, which is faster than in the order in which the metal opened.
            for (i, (&openness, dust)) in stains.openness.iter().zip(&mut stains.metal.dust).enumerate() {
                if openness > 0.0 {
                    let left = rates.left_on_metal(mesh, &stains.duplicates, &basis, VertexId::new(i), openness);
                    *dust = 1.0 - (1.0 - *dust) * left;
                }
            }
        }
    }
    rates.give_back(basis);
    stains.dust_rates = rates;
    if settings.rate > 0.0 {
        stains.revise_if_seen();
    }
}
