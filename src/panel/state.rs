//! Defines [`CoatingPanel`], the state of the panel.

use std::collections::BTreeMap;

use bevy::ecs::{entity::Entity, resource::Resource, system::Res};
use bevy_egui::egui::Rect;

use super::{seen::Seen, widget::PanelWidget};
use crate::settings::{CoatingSettings, Preset};

/// Default of [`CoatingPanel::keyframe_bytes`]: 4 MiB.
const KEYFRAME_BYTES: usize = 4 << 20;

/// State of the panel: what it shows, and for which prop.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::CoatingPanel;
///
/// fn toggle(keys: Res<ButtonInput<KeyCode>>, mut panel: ResMut<CoatingPanel>) {
///     if keys.just_pressed(KeyCode::F2) {
///         panel.open = !panel.open;
///     }
/// }
/// # let mut app = App::new();
/// # app.init_resource::<ButtonInput<KeyCode>>().init_resource::<CoatingPanel>().add_systems(Update, toggle);
/// # app.update();
/// assert!(CoatingPanel::default().open);
/// ```
#[derive(Resource, Clone, Debug)]
pub struct CoatingPanel {
    /// Whether the panel is there. Default true.
    pub open: bool,
    /// Entity with the `Coating` whose settings are shown. `None`, the default, and an entity without a coating: the
    /// first by name, which is written here.
    pub prop: Option<Entity>,
    /// Whether changes of settings and the bar of ages act on all props. Default false: on the chosen one.
    pub all_props: bool,
    /// Path of the settings file that is loaded and saved, from the program's working folder. Default
    /// `paint.coating.ron`.
    pub file: String,
    /// Whether the file is loaded again whenever it changes on the disk, for the props on which changes act. Default
    /// false.
    pub follows_file: bool,
    /// Memory for the past of each film, in bytes: while the panel is open it gives a
    /// [`CoatingHistory`](crate::CoatingHistory) of so much to every coating without one, so that films can go back. It
    /// stays when the panel is closed. Default 4 MiB; at 0 the panel gives none.
    pub keyframe_bytes: usize,
    /// Path of the model that is baked, or a test piece like `plate:3012`: see [`Input`](crate::bake::Input). Default
    /// empty.
    #[cfg(feature = "bake")]
    pub model: String,
    /// File at which the panel has looked last.
    pub(super) seen: Option<Seen>,
    /// Whether the file has changed and is to be loaded.
    pub(super) file_has_changed: bool,
    /// Last message: what was loaded or saved, or why that failed.
    pub(super) message: String,
    /// Settings to which resetting goes back: those that were loaded last, or of the
    /// preset that a prop had when it was chosen.
    pub(super) base: CoatingSettings,
    /// Name of these settings.
    pub(super) base_name: String,
    /// Age at which the state of each prop was saved.
    pub(super) saved: BTreeMap<Entity, f64>,
    /// Places of the widgets, as they were last drawn.
    pub(super) places: BTreeMap<PanelWidget, Rect>,
}

impl Default for CoatingPanel {
    fn default() -> Self {
        Self {
            open: true,
            prop: None,
            all_props: false,
            file: "paint.coating.ron".to_owned(),
            follows_file: false,
            keyframe_bytes: KEYFRAME_BYTES,
            #[cfg(feature = "bake")]
            model: String::new(),
            seen: None,
            file_has_changed: false,
            message: String::new(),
            base: CoatingSettings::default(),
            base_name: Preset::Default.name().to_owned(),
            saved: BTreeMap::new(),
            places: BTreeMap::new(),
        }
    }
}

impl CoatingPanel {
    /// Returns the place of a widget in the view as it was last drawn, in points; `None` if it never was. For tours
    /// that point at it, and tests. A widget that has been scrolled away lies outside of its side.
    pub fn place(&self, widget: PanelWidget) -> Option<Rect> {
        self.places.get(&widget).copied()
    }

    /// Returns all widgets that have been drawn, with their places.
    pub fn places(&self) -> impl Iterator<Item = (PanelWidget, Rect)> + '_ {
        self.places.iter().map(|(&widget, &rect)| (widget, rect))
    }

    /// Returns the last message: what was loaded or saved, or why that failed. Empty at first.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Lets resetting go back to the preset with these settings, if there is one.
    pub(super) fn rebase(&mut self, settings: Option<&CoatingSettings>) {
        let Some(settings) = settings else { return };
        let is_theirs = |preset: &Preset| CoatingSettings::from(*preset) == *settings;
        if let Some(preset) = Preset::ALL.into_iter().find(is_theirs) {
            self.set_base(preset.name(), &preset.into());
        }
    }

    /// Sets the settings to which resetting goes back.
    pub(super) fn set_base(&mut self, name: &str, settings: &CoatingSettings) {
        self.base.clone_from(settings);
        name.clone_into(&mut self.base_name);
    }
}

/// Returns whether the panel is open.
pub(super) fn is_open(panel: Res<CoatingPanel>) -> bool {
    panel.open
}
