//! Defines [`HeatMapView`], the component that colours films by a quantity.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

use crate::heat::{HeatMap, HeatRange};

/// Request to colour films by a [`HeatMap`], on the entity with the [`Coating`](super::coating::Coating) for all its
/// films, or on the entity of one film, which counts first.
///
/// The colours are a mesh of their own just over the front of the paint, which has the film's own triangles, follows
/// them as they move and age, and is written only when the film changed. The prop's own meshes and materials stay as
/// they are, so everything is as before when the component is removed. While it is shown, the film is drawn at level 0:
/// the curved faces of a finer [`Detail`](crate::appearance::Detail) would bulge through it. It needs the
/// feature `render` and Bevy's `StandardMaterial`.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{HeatMapView, heat::HeatMap, prelude::*};
///
/// /// Shows on all props where paint comes off next, and on the next call nothing.
/// fn toggle(mut commands: Commands, props: Query<(Entity, Has<HeatMapView>), With<Coating>>) {
///     for (prop, shown) in &props {
///         if shown {
///             commands.entity(prop).remove::<HeatMapView>();
///         } else {
///             commands.entity(prop).insert(HeatMapView::new(HeatMap::Adhesion));
///         }
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, toggle);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct HeatMapView {
    /// Quantity that is shown. Default: [`HeatMap::Adhesion`].
    pub map: HeatMap,
    /// Range over which the colours are spread. `None`, the default: that of the map ([`HeatMap::range`]).
    pub range: Option<HeatRange>,
}

impl HeatMapView {
    /// Returns a view of `map` over its own range.
    pub fn new(map: HeatMap) -> Self {
        Self { map, range: None }
    }

    /// Returns the range over which the colours are spread.
    ///
    /// ```
    /// use bevy_coating::{HeatMapView, heat::{HeatMap, HeatRange}};
    ///
    /// let view = HeatMapView::new(HeatMap::Strain);
    /// assert_eq!(view.spread(), HeatMap::Strain.range());
    /// let narrow = HeatRange { min: 0.0, max: 0.01 };
    /// assert_eq!(HeatMapView { range: Some(narrow), ..view }.spread(), narrow);
    /// ```
    pub fn spread(&self) -> HeatRange {
        self.range.unwrap_or(self.map.range())
    }
}
