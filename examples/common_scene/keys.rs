//! Keys of the window: one table, from which they act and by which they are listed.

use bevy::prelude::KeyCode;

/// What a key does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Command {
    Pause,
    Step,
    Faster,
    Slower,
    Next,
    Previous,
    Repaint,
    Help,
    Close,
}

/// What each command is called, and its keys with their names.
const COMMANDS: [(Command, &str, &[(KeyCode, &str)]); 9] = [
    (Command::Pause, "pause and go on", &[(KeyCode::Space, "Space")]),
    (Command::Step, "pause and take one step", &[(KeyCode::KeyS, "S"), (KeyCode::KeyN, "N")]),
    (
        Command::Faster,
        "age faster",
        &[(KeyCode::ArrowUp, "Up"), (KeyCode::Equal, "="), (KeyCode::NumpadAdd, "keypad +")],
    ),
    (
        Command::Slower,
        "age slower",
        &[(KeyCode::ArrowDown, "Down"), (KeyCode::Minus, "-"), (KeyCode::NumpadSubtract, "keypad -")],
    ),
    (Command::Next, "next view", &[(KeyCode::ArrowRight, "Right"), (KeyCode::PageDown, "Page Down")]),
    (Command::Previous, "view before", &[(KeyCode::ArrowLeft, "Left"), (KeyCode::PageUp, "Page Up")]),
    (Command::Repaint, "fresh paint", &[(KeyCode::KeyR, "R")]),
    (Command::Help, "show or hide the list of keys", &[(KeyCode::KeyH, "H")]),
    (Command::Close, "close the window", &[(KeyCode::Escape, "Escape")]),
];

/// What the mouse does, and what it does where the scene has a use for the right button.
const MOUSE: [(&str, &str); 3] =
    [("Left drag", "turn around the scene"), ("Right or middle drag", "shift it"), ("Wheel", "zoom")];
const MOUSE_WITHOUT_RIGHT: [(&str, &str); 3] = [MOUSE[0], ("Middle drag", MOUSE[1].1), MOUSE[2]];

/// A movement of the mouse that a scene may have a use of its own for.
pub const RIGHT_DRAG: &str = "Right drag";

/// Keys and movements of the mouse that only one scene has, with their meanings.
pub type Own = &'static [(&'static str, &'static str)];

/// Whether the right button is the scene's.
pub fn right_is_taken(own: Own) -> bool {
    own.iter().any(|(keys, _)| *keys == RIGHT_DRAG)
}

/// Keys of the views.
pub const DIGITS: [KeyCode; 9] = [
    KeyCode::Digit1,
    KeyCode::Digit2,
    KeyCode::Digit3,
    KeyCode::Digit4,
    KeyCode::Digit5,
    KeyCode::Digit6,
    KeyCode::Digit7,
    KeyCode::Digit8,
    KeyCode::Digit9,
];

/// What `key` does.
pub fn command(key: KeyCode) -> Option<Command> {
    let is_one_of = |keys: &[(KeyCode, &str)]| keys.iter().any(|(one, _)| *one == key);
    COMMANDS.iter().find(|(_, _, keys)| is_one_of(keys)).map(|(command, ..)| *command)
}

/// Every key and mouse movement with its meaning: those of all scenes, of which the digits choose `views`, and then the
/// scene's `own`.
pub fn list(views: &[&str], own: Own) -> Vec<(String, String)> {
    let views = views.iter().zip(1..=DIGITS.len()).map(|(view, digit)| (digit.to_string(), format!("view: {view}")));
    let commands = COMMANDS.iter().map(|(_, meaning, keys)| {
        let keys: Vec<&str> = keys.iter().map(|(_, name)| *name).collect();
        (keys.join(", "), (*meaning).to_owned())
    });
    let mouse = if right_is_taken(own) { &MOUSE_WITHOUT_RIGHT } else { &MOUSE };
    let mouse = mouse.iter().chain(own).map(|(movement, meaning)| ((*movement).to_owned(), (*meaning).to_owned()));
    views.chain(commands).chain(mouse).collect()
}

/// The same list as text for the command line's help.
pub fn help(views: &[&str], own: Own) -> String {
    let lines = list(views, own).into_iter().map(|(keys, meaning)| format!("\n  {keys:<20} {meaning}"));
    format!("Keys of the window:{}", lines.collect::<String>())
}
