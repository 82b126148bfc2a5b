//! Collects what the panel shows, so that drawing it touches nothing.

use std::sync::Arc;

use bevy::{
    asset::Assets,
    diagnostic::{DiagnosticPath, DiagnosticsStore},
    ecs::{
        entity::Entity,
        name::Name,
        query::QueryData,
        system::{Commands, Query, Res, ResMut, SystemParam},
    },
    gizmos::config::GizmoConfigStore,
};

#[cfg(feature = "bake")]
use super::bake_job::BakeJob;
use super::{
    state::CoatingPanel,
    statistics::{Sample, Statistics},
};
#[cfg(feature = "bake")]
use crate::api::seed::CoatingSeed;
use crate::{
    api::{
        clock::CoatingClock, coating::Coating, diagnostics, heat_map_view::HeatMapView, links::CoatedBy,
        paint::SettingsSource, snapshot::CoatingSnapshot, summary::FilmSummary,
    },
    film::FilmMesh,
    gizmos::CoatingGizmos,
    pointing::CoatingBrush,
    settings::CoatingSettings,
    sim::FilmClock,
    survey::{FilmShares, Ratings},
    timeline::FilmHistory,
};

/// Stages whose times are shown, with their names.
const STAGES: [(&str, DiagnosticPath); 5] = [
    ("fracture", diagnostics::FRACTURE),
    ("bending", diagnostics::DEFORMATION),
    ("stains", diagnostics::STAINS),
    ("meshes", diagnostics::MESH_GENERATION),
    ("other", diagnostics::OTHER),
];

/// Coating and what lies beside it.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Prop {
    pub entity: Entity,
    pub coating: &'static mut Coating,
    pub name: Option<&'static Name>,
    pub heat: Option<&'static HeatMapView>,
    pub snapshot: Option<&'static CoatingSnapshot>,
    #[cfg(feature = "bake")]
    pub seed: Option<&'static CoatingSeed>,
}

/// Everything in the world that the panel reads and writes.
#[derive(SystemParam)]
pub(super) struct PanelWorld<'w, 's> {
    pub commands: Commands<'w, 's>,
    pub props: Query<'w, 's, Prop>,
    pub films:
        Query<'w, 's, (&'static CoatedBy, &'static mut FilmClock, &'static FilmMesh, Option<&'static FilmHistory>)>,
    pub clock: ResMut<'w, CoatingClock>,
    pub gizmos: Option<ResMut<'w, GizmoConfigStore>>,
    pub brush: Option<ResMut<'w, CoatingBrush>>,
    pub assets: Res<'w, Assets<CoatingSettings>>,
    #[cfg(feature = "bake")]
    pub bake: ResMut<'w, BakeJob>,
    summaries: Query<'w, 's, (&'static CoatedBy, &'static FilmSummary)>,
    diagnostics: Option<Res<'w, DiagnosticsStore>>,
    statistics: Res<'w, Statistics>,
}

/// One prop in the list.
pub(super) struct PropLine {
    pub entity: Entity,
    pub name: String,
    /// Age of the youngest of its films; `None` while none is ready.
    pub age: Option<f64>,
    /// Number of triangles of its films.
    pub triangles: usize,
}

/// Everything that the panel shows.
pub(super) struct View {
    pub props: Vec<PropLine>,
    /// Prop whose settings are shown.
    pub chosen: Option<Entity>,
    /// Its settings; `None` without a prop, or while they are being loaded.
    pub settings: Option<CoatingSettings>,
    /// Name of the settings to which resetting goes back.
    pub base: CoatingSettings,
    pub heat: Option<HeatMapView>,
    /// Whether a state of the prop has been saved.
    pub is_saved: bool,
    pub is_paused: bool,
    pub age_per_second: f64,
    /// Age of the prop, or the one that it is being brought to.
    pub age: f64,
    /// Greatest age that it has had.
    pub oldest: f64,
    /// Whether it is on its way.
    pub travels: bool,
    /// Milliseconds of each stage, with its name.
    pub times: [(&'static str, Option<f64>); 5],
    /// Whether gizmos are drawn; `None` where they cannot be.
    pub gizmos: Option<bool>,
    /// Brush in the hand; `None` where nothing points at films.
    pub brush: Option<CoatingBrush>,
    /// Shares by area of all films of the prop, with their ratings.
    pub rated: Option<(FilmShares, Ratings)>,
    /// Share of baking that is done, while a model is baked.
    #[cfg(feature = "bake")]
    pub baked: Option<f32>,
    /// Figures of the prop, by age.
    pub samples: Arc<Vec<Sample>>,
}

impl PanelWorld<'_, '_> {
    /// Collects what there is to show, and chooses a prop if none is.
    pub fn view(&self, panel: &mut CoatingPanel) -> View {
        let mut props: Vec<PropLine> = self.props.iter().map(|prop| self.line(prop.entity, prop.name)).collect();
        props.sort_by(|a, b| a.name.cmp(&b.name).then(a.entity.index_u32().cmp(&b.entity.index_u32())));
        if !panel.prop.is_some_and(|chosen| props.iter().any(|prop| prop.entity == chosen)) {
            panel.prop = props.first().map(|prop| prop.entity);
            let first = panel.prop.and_then(|first| self.props.get(first).ok());
            panel.rebase(first.as_ref().and_then(|prop| settings_of(prop.coating, &self.assets)));
        }
        let chosen = panel.prop;
        let prop = chosen.and_then(|chosen| self.props.get(chosen).ok());
        let films = self.films.iter().filter(|(coated_by, ..)| Some(coated_by.0) == chosen);
        let (mut age, mut oldest, mut travels) = (0.0f64, 0.0f64, false);
        for (_, clock, _, history) in films {
            age = age.max(clock.sought().unwrap_or(clock.age()));
            oldest = oldest.max(history.map_or(clock.age(), |history| history.last_age(clock)));
            travels |= clock.sought().is_some();
        }
        View {
            props,
            chosen,
            settings: prop.as_ref().and_then(|prop| settings_of(prop.coating, &self.assets)).cloned(),
            base: panel.base.clone(),
            heat: prop.as_ref().and_then(|prop| prop.heat.copied()),
            is_saved: prop.as_ref().is_some_and(|prop| prop.snapshot.is_some()),
            is_paused: self.clock.paused,
            age_per_second: self.clock.age_per_second,
            age,
            oldest,
            travels,
            times: STAGES.map(|(name, path)| (name, self.time(&path))),
            gizmos: self.gizmos.as_ref().and_then(|store| Some(store.get_config::<CoatingGizmos>()?.0.enabled)),
            brush: self.brush.as_ref().map(|brush| CoatingBrush::clone(brush)),
            rated: self.rated(chosen),
            #[cfg(feature = "bake")]
            baked: self.bake.done(),
            samples: chosen.map(|chosen| self.statistics.of(chosen)).unwrap_or_default(),
        }
    }

    fn line(&self, entity: Entity, name: Option<&Name>) -> PropLine {
        let (mut age, mut triangles) = (None, 0);
        for (_, clock, mesh, _) in self.films.iter().filter(|(coated_by, ..)| coated_by.0 == entity) {
            let own = clock.age();
            age = Some(age.map_or(own, |youngest: f64| youngest.min(own)));
            triangles += mesh.topology.face_count() - mesh.topology.removed_face_count();
        }
        let name = name.map_or_else(|| entity.to_string(), |name| name.as_str().to_owned());
        PropLine { entity, name, age, triangles }
    }

    /// Returns the shares and the ratings of all films of a prop together.
    fn rated(&self, prop: Option<Entity>) -> Option<(FilmShares, Ratings)> {
        let own = self.summaries.iter().filter(|(coated_by, _)| Some(coated_by.0) == prop);
        let shares = own.map(|(_, summary)| summary.shares).reduce(|all, film| all.merged(&film))?;
        Some((shares, Ratings::from(&shares)))
    }

    fn time(&self, path: &DiagnosticPath) -> Option<f64> {
        self.diagnostics.as_ref()?.get(path)?.smoothed()
    }
}

/// Returns the settings of a coating; `None` while their asset is being loaded.
pub(super) fn settings_of<'a>(
    coating: &'a Coating,
    assets: &'a Assets<CoatingSettings>,
) -> Option<&'a CoatingSettings> {
    match &coating.settings {
        SettingsSource::Inline(settings) => Some(settings),
        SettingsSource::Asset(handle) => assets.get(handle),
    }
}
