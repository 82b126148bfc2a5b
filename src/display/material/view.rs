//! Defines [`StainView`], the quantity that the stain shader draws.

use bevy::reflect::prelude::*;

/// Quantity of a stained surface that is drawn: the lit surface, or one of its inputs for tests and debugging.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{StainView, StainedMaterial};
///
/// /// Draws the base colours of all stained surfaces instead of lit ones.
/// fn show_base_colors(mut materials: ResMut<Assets<StainedMaterial>>) {
///     for (_, material) in materials.iter_mut() {
///         material.extension.view = StainView::BaseColor;
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default())).init_asset::<StainedMaterial>();
/// # app.add_systems(Update, show_base_colors);
/// # app.update();
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
#[type_path = "bevy_coating::display::material"]
pub enum StainView {
    /// Lit surface.
    #[default]
    Lit,
    /// Base colour, unlit.
    BaseColor,
    /// Metalness, roughness and reflectance as red, green and blue.
    Surface,
    /// Normal in world space: from -1 (black) to 1 (full) in each channel.
    Normal,
}
