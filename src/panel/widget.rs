//! Names of the panel's widgets.

use bevy::ecs::entity::Entity;

use crate::heat::HeatMap;

/// Widget of the panel whose place can be asked for: [`CoatingPanel::place`](super::CoatingPanel::place).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PanelWidget {
    /// Settings, at the left of the view.
    Left,
    /// Props, maps and figures, at the right.
    Right,
    /// Clock, at the bottom.
    Bottom,
    /// Slider of the setting with this path, like `tearing.alpha`; the names, if the setting has some.
    Setting(&'static str),
    /// Field with the number of the setting with this path.
    Number(&'static str),
    /// Button that resets the setting with this path.
    Reset(&'static str),
    /// Button that resets all settings.
    ResetAll,
    /// Button that loads the preset with this name.
    Preset(&'static str),
    /// Path of the file that is loaded and saved.
    File,
    /// Button that loads the file.
    LoadFile,
    /// Button that saves the file.
    SaveFile,
    /// Box that lets the file be loaded again when it changes.
    FollowFile,
    /// Title of the group with which models are baked.
    #[cfg(feature = "bake")]
    BakeGroup,
    /// Path of the model that is baked.
    #[cfg(feature = "bake")]
    Model,
    /// Button that bakes the model.
    #[cfg(feature = "bake")]
    Bake,
    /// Box that lets changes of settings act on all props.
    AllProps,
    /// Line of a prop.
    Prop(Entity),
    /// Button of a heat map; of none where it is `None`.
    Heat(Option<HeatMap>),
    /// Box that switches the gizmos.
    Gizmos,
    /// Button of the brush with this name, like `weaken`.
    Brush(&'static str),
    /// Slider of the brush's radius.
    BrushRadius,
    /// Button that takes the last stroke back.
    Undo,
    /// Button that lets the stroke happen again that was taken back last.
    Redo,
    /// Button that saves the state of the prop.
    SaveState,
    /// Button that puts the prop back into its saved state.
    RestoreState,
    /// Button that runs and pauses the clock.
    Run,
    /// Button that takes a step.
    Step,
    /// Bar that goes to any age.
    Age,
    /// Slider of the clock's speed.
    Speed,
}
