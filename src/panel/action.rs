//! Things that somebody has asked for by a widget.

use bevy::ecs::entity::Entity;

use crate::{
    heat::HeatMap,
    pointing::CoatingBrush,
    settings::{Field, Preset},
};

/// Thing to be done after the panel has been drawn.
#[derive(Clone, Debug)]
pub(super) enum Action {
    /// Choose a prop.
    Choose(Entity),
    /// Set a setting.
    Set(&'static Field, f32),
    /// Set all settings back to those that were loaded last.
    ResetAll,
    /// Load a preset.
    Preset(Preset),
    /// Load the settings file.
    LoadFile,
    /// Save the settings into the file.
    SaveFile,
    /// Follow the settings file, or do not.
    FollowFile(bool),
    /// Age the model with the chosen prop's paint, and write it.
    #[cfg(feature = "bake")]
    Bake,
    /// Show a heat map, or none.
    Heat(Option<HeatMap>),
    /// Switch the gizmos on or off.
    Gizmos(bool),
    /// Take this brush into the hand.
    Brush(CoatingBrush),
    /// Take the last stroke back.
    Undo,
    /// Let it happen again.
    Redo,
    /// Save the state of the prop.
    SaveState,
    /// Put the prop back into its saved state.
    RestoreState,
    /// Pause the clock or let it run.
    Pause(bool),
    /// Take a step.
    Step,
    /// Set the speed of the clock, an age per second.
    Speed(f64),
    /// Bring films to an age.
    Age(f64),
}
