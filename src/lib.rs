//! Paint on metal that separates, cracks, curls, flakes off and rusts while a Bevy game runs.

pub mod deform;
pub mod film;
pub mod fracture;
pub mod settings;
pub mod sim;
