//! Codes the constraints of a film for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::FilmConstraints;
use crate::{
    coding::{Coder, Damage, number},
    deform::{
        bend::bend_points,
        curl::CurlField,
        ledger::saved::{Expected, Place},
        pace::{Narrowing, SolverQuality},
        packed::points::Motion,
    },
    film::{FilmMesh, HalfEdgeId, VertexId},
    settings::DeformSettings,
};

impl FilmConstraints {
    /// Codes how these constraints differ from those of a fresh film. To read, begin with those. `mesh` is the film as
    /// it is, `rest` the same at rest, `dt` the length of its steps, and
    /// `is_attached` says which vertices the metal holds.
    ///
    /// # Errors
    /// [`Damage`] if what is read does not fit the film.
    pub(crate) fn code_state<C: Coder>(
        &mut self,
        mesh: &FilmMesh,
        rest: &FilmMesh,
        is_attached: impl Fn(VertexId) -> bool,
        dt: f32,
        coder: &mut C,
    ) -> Result<(), Damage> {
        code_settings(&mut self.settings, coder)?;
        CurlField::code_state(&mut self.curl, mesh, rest, coder)?;
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let held = |i: usize| is_attached(VertexId::new(i));
        self.packed.code_points(topology, &geometry.positions, held, coder)?;
        let points = self.packed.points();
        self.sleep.code_state(&geometry.positions, |v| points.position_before(v), held, coder)?;
        let by = self.settings.as_ref().map_or(Narrowing { step: 0.0, limit: 0.0 }, |(settings, _)| Narrowing {
            step: settings.narrowing_rate * dt,
            limit: settings.bend_limit,
        });
        let packs = self.packed.code_pack_counts(mesh, coder)?;
        let (packed, curl) = (&self.packed, self.curl.as_deref().filter(|curl| curl.covers(topology)));
        let expected = |h: HalfEdgeId| {
            let carries = topology.is_live(h.face()) && topology.bound_twin(h).is_none_or(|twin| h < twin);
            let bends = carries && topology.bound_twin(h).is_some();
            let place = |is_there: bool, vertices: &[u32]| match is_there {
                false => Place::None,
                true if vertices.iter().any(|&v| packed.motion(VertexId(v)) == Motion::Awake) => Place::Packed,
                true => Place::Parked,
            };
            let ends = [topology.origin(h), topology.target(h)];
            let length = place(carries && !ends.into_iter().all(&is_attached), &ends.map(|v| v.0));
            let pushed = |h: HalfEdgeId| !is_attached(topology.apex(h));
            let pushes = bends && topology.bound_twin(h).is_some_and(|twin| pushed(h) || pushed(twin));
            let share = curl.filter(|_| topology.rest_twin(h).is_some_and(|twin| h < twin));
            Expected {
                length,
                bend: place(pushes, &bend_points(topology, h)),
                may: [carries, bends],
                start: geometry.rest_dihedrals.get(h.index()).copied().unwrap_or_default(),
                share: share.map_or(1.0, |curl| curl.share(topology, h)),
                region: packed.region_index(topology, h),
                was: topology.is_torn(h) || !topology.is_live(h.face()),
            }
        };
        self.ledger.code_state(by.limit, &packs, expected, coder)?;
        self.packed.code_packs(mesh, &self.ledger, &packs, by, coder)?;
        if coder.distrusts() {
            self.validate(mesh, is_attached).map_err(|_| Damage("a constraint"))?;
        }
        Ok(())
    }
}

fn code_settings<C: Coder>(
    settings: &mut Option<(DeformSettings, SolverQuality)>,
    coder: &mut C,
) -> Result<(), Damage> {
    if coder.plain(u32::from(settings.is_some()), 1) == 0 {
        *settings = None;
        return Ok(());
    }
    let (mut last, quality) = settings.take().unwrap_or_default();
    let DeformSettings { narrowing_rate, bend_limit, curl_reach, sweeps_per_age } = &mut last;
    for number in [narrowing_rate, bend_limit, curl_reach, sweeps_per_age] {
        coder.plain_float(number);
    }
    let quality = code_quality(quality, coder)?;
    *settings = Some((last, quality));
    Ok(())
}

/// Codes a quality.
///
/// # Errors
/// [`Damage`] if there is no quality of that number.
pub(crate) fn code_quality<C: Coder>(quality: SolverQuality, coder: &mut C) -> Result<SolverQuality, Damage> {
    let place = SolverQuality::ALL.iter().position(|&known| known == quality).unwrap_or_default();
    let place = coder.plain(number(place), 2);
    SolverQuality::ALL.get(place as usize).copied().ok_or(Damage("the quality of its solver"))
}
