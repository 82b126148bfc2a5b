//! Imports go down the ladder of rooms, and nowhere in circles; the core does not know Bevy.

use std::collections::{BTreeMap, BTreeSet};

use crate::{
    Source, assert_none,
    imports::{Arrow, Modules},
    parse::is_test,
    sources,
    tokens::{Token, after_closing, begins_with, tokens, without_items},
};

/// Rooms (files and folders of `src`) from the lowest upwards. Those of one rung may import from each other, one way.
const LADDER: [&[&str]; 15] = [
    &["coding", "files", "rest"],
    &["settings", "film"],
    &["surface", "remesh"],
    &["fracture", "deform", "stain"],
    &["sim"],
    &["extras", "masks", "touch"],
    &["snapshot", "survey"],
    &["history"],
    &["appearance", "heat"],
    &["bake"],
    &["api", "mesh_reader"],
    &["display", "inspect", "gizmos", "shelter", "timeline", "stepping", "attach", "pointing", "debris"],
    &["panel", "plugin"],
    &["prelude"],
    &["lib"],
];

/// Rooms that do without the engine.
const CORE: [&str; 20] = [
    "coding",
    "files",
    "rest",
    "settings",
    "film",
    "surface",
    "remesh",
    "fracture",
    "deform",
    "stain",
    "sim",
    "touch",
    "extras",
    "masks",
    "snapshot",
    "survey",
    "history",
    "appearance",
    "heat",
    "bake",
];

/// The file of the core that is about Bevy's assets.
const ENGINE_FILES: [&str; 1] = ["settings/asset.rs"];

fn room(file: &str) -> &str {
    file.split('/').next().expect("a name").trim_end_matches(".rs")
}

fn rung(room: &str) -> Option<usize> {
    LADDER.iter().position(|rooms| rooms.contains(&room))
}

/// Imports that lead to a higher rung, by the module that is named or by the one that defines what is.
fn upward(modules: &Modules) -> Vec<String> {
    let mut found = Vec::new();
    for Arrow { from, to, by, line, written } in modules.arrows() {
        let (from, to) = (&modules.files[from], &modules.files[to]);
        let by = by.first().map_or("lib", String::as_str);
        for target in BTreeSet::from([by, room(to)]) {
            match (rung(room(from)), rung(target)) {
                (Some(low), Some(high)) if high <= low => {}
                (Some(_), Some(_)) => found.push(format!("src/{from}:{line}: {written} leads up to {target}")),
                _ => found.push(format!("src/{from}:{line}: {written}: {target} or this room is not on the ladder")),
            }
        }
    }
    found
}

type Next<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// Nodes to which arrows lead from `start`.
fn reached<'a>(next: &Next<'a>, start: &str) -> BTreeSet<&'a str> {
    let (mut seen, mut open) = (BTreeSet::new(), next.get(start).into_iter().flatten().copied().collect::<Vec<_>>());
    while let Some(node) = open.pop() {
        if seen.insert(node) {
            open.extend(next.get(node).into_iter().flatten());
        }
    }
    seen
}

/// Circles among nodes: each the arrows between nodes that reach each other.
fn circles(arrows: &[(&str, &str, String)]) -> Vec<String> {
    let mut next = Next::new();
    for (from, to, _) in arrows.iter().filter(|(from, to, _)| from != to) {
        next.entry(from).or_default().insert(to);
    }
    let reached: Next = next.keys().map(|&node| (node, reached(&next, node))).collect();
    let meet = |a: &str, b: &str| a != b && reached[a].contains(b) && reached.get(b).is_some_and(|r| r.contains(a));
    let mut found: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (from, to, how) in arrows {
        if from != to && meet(from, to) {
            // All of a circle reach the same of it.
            let first = reached[from].iter().copied().find(|&node| node == *from || meet(from, node));
            found.entry(first.unwrap_or(from)).or_default().push(format!("{from} -> {to} ({how})"));
        }
    }
    found.into_values().map(|arrows| arrows.join("\n    ")).collect()
}

/// Returns whether `file` lies below the folder whose `mod.rs` is `parent`. Such arrows make no circle: a `mod.rs` may
/// both hold what the files of its folder share and call them.
fn is_below(file: &str, parent: &str) -> bool {
    parent.strip_suffix("mod.rs").is_some_and(|folder| file.starts_with(folder))
}

/// Circles among files, each taken for the node that it belongs to.
fn circles_by(modules: &Modules, node: impl for<'a> Fn(&'a str) -> &'a str) -> Vec<String> {
    let mut arrows = modules.arrows();
    let kin = |arrow: &Arrow| is_below(&modules.files[arrow.from], &modules.files[arrow.to]);
    arrows.retain(|arrow| !kin(arrow));
    arrows.dedup_by_key(|arrow| (arrow.from, arrow.to));
    let name = |arrow: &Arrow| format!("src/{}:{}: {}", modules.files[arrow.from], arrow.line, arrow.written);
    let ends = |arrow: &Arrow| (node(&modules.files[arrow.from]), node(&modules.files[arrow.to]));
    circles(&arrows.iter().map(|a| (ends(a).0, ends(a).1, name(a))).collect::<Vec<_>>())
}

/// Places in the core that name the engine outside of what the feature `plugin` switches on.
fn engine_names(sources: &[Source]) -> Vec<String> {
    let is_switched = |attribute: &[Token]| {
        let feature = |word| begins_with(attribute, &[word, "(", "feature", "=", "\"plugin\""]);
        feature("cfg") || feature("cfg_attr")
    };
    let is_core = |file: &str| CORE.contains(&room(file)) && !ENGINE_FILES.contains(&file);
    let mut found = Vec::new();
    for (file, source) in sources.iter().filter(|(file, _)| is_core(file)) {
        // Attributes that are switched on go first, or they would take their items along.
        let tokens = without_attributes(&tokens(source), |a| is_switched(a) && a[0].is("cfg_attr"));
        for token in without_items(&tokens, |a| is_switched(a) || is_test(a)).0 {
            if token.text.starts_with("bevy") && !["bevy_math", "bevy_coating"].contains(&token.text.as_str()) {
                found.push(format!("src/{file}:{}: {}", token.line, token.text));
            }
        }
    }
    found
}

/// Drops attributes for which `goes` holds.
fn without_attributes(tokens: &[Token], goes: impl Fn(&[Token]) -> bool) -> Vec<Token> {
    let (mut kept, mut i) = (Vec::new(), 0);
    while i < tokens.len() {
        if tokens[i].is("#") && tokens.get(i + 1).is_some_and(|t| t.is("[")) {
            let end = after_closing(tokens, i + 1);
            if goes(&tokens[i + 2..end - 1]) {
                i = end;
                continue;
            }
        }
        kept.push(tokens[i].clone());
        i += 1;
    }
    kept
}

#[test]
fn imports_go_down_the_ladder() {
    assert_none(&upward(&Modules::new(&sources("src"))), "imports lead down");
}

#[test]
fn rooms_do_not_import_in_circles() {
    assert_none(&circles_by(&Modules::new(&sources("src")), room), "rooms import one way");
}

#[test]
fn files_do_not_import_in_circles() {
    assert_none(&circles_by(&Modules::new(&sources("src")), |file| file), "files import one way");
}

#[test]
fn the_core_does_not_know_the_engine() {
    assert_none(&engine_names(&sources("src")), "the core knows bevy_math alone");
}

mod rules {
    //! The rules find what breaks them.

    use super::*;

    fn crate_of(files: &[(&str, &str)]) -> Vec<Source> {
        files.iter().map(|&(name, source)| (name.to_owned(), source.to_owned())).collect()
    }

    fn modules(files: &[(&str, &str)]) -> Modules {
        Modules::new(&crate_of(files))
    }

    const LIB: (&str, &str) = ("lib.rs", "mod film; mod sim; pub use sim::Sim; pub use api::coating::Coating;");

    #[test]
    fn an_import_from_a_higher_room_is_found() {
        let sim = ("sim/mod.rs", "pub struct Sim; use crate::film::Film;");
        assert_eq!(upward(&modules(&[LIB, sim, ("film/mod.rs", "pub struct Film;")])), Vec::<String>::new());
        for line in ["use crate::{sim::Sim};", "fn f(_: super::sim::Sim) {}", "use crate::sim; fn f() { sim::g() }"] {
            let film = ("film/mod.rs", &*format!("pub struct Film;\n{line}"));
            let found = upward(&modules(&[LIB, sim, film]));
            assert_eq!(found.len(), 1, "{line}: {found:?}");
            assert!(found[0].starts_with("src/film/mod.rs:2: ") && found[0].ends_with(" leads up to sim"), "{found:?}");
        }
        // The name of the root leads up, wherever it comes from.
        let film = ("film/mod.rs", "pub struct Film; pub struct Handle;");
        let found = upward(&modules(&[
            ("lib.rs", "mod film; mod sim; pub use film::Film;"),
            film,
            ("sim/mod.rs", "use crate::Film;"),
        ]));
        assert_eq!(found, ["src/sim/mod.rs:1: crate::Film leads up to lib"]);
        let found =
            upward(&modules(&[("lib.rs", "mod cellar; mod film;"), film, ("cellar.rs", "use crate::film::Film;")]));
        assert!(found[0].contains("not on the ladder"), "{found:?}");
    }

    #[test]
    fn a_circle_of_rooms_is_found() {
        let deform = ("deform/mod.rs", "use crate::stain::flow::Flow;\npub struct Solver;");
        let stain = ("stain/mod.rs", "mod flow; pub use flow::Flow;");
        let one_way = modules(&[LIB, deform, stain, ("stain/flow.rs", "pub struct Flow;")]);
        assert_eq!(circles_by(&one_way, room), Vec::<String>::new());
        let around = modules(&[LIB, deform, stain, ("stain/flow.rs", "pub struct Flow(crate::deform::Solver);")]);
        assert_eq!(upward(&around), Vec::<String>::new());
        let found = circles_by(&around, room);
        assert_eq!(found.len(), 1);
        assert!(found[0].contains("deform -> stain (src/deform/mod.rs:1: crate::stain::flow::Flow)"), "{found:?}");
        assert!(found[0].contains("stain -> deform (src/stain/flow.rs:1: crate::deform::Solver)"), "{found:?}");
    }

    #[test]
    fn a_circle_of_files_is_found() {
        let facade = ("film/mod.rs", "mod child; mod other; pub use {child::work, other::Other};");
        let child = ("film/child.rs", "pub fn work() {}");
        let other = ("film/other.rs", "use super::work; pub struct Other;");
        assert_eq!(circles_by(&modules(&[LIB, facade, child, other]), |file| file), Vec::<String>::new());
        for back in ["use super::Other;", "fn f(_: super::other::Other) {}", "use super::other; fn f() { other::g() }"]
        {
            let child = ("film/child.rs", &*format!("pub fn work() {{}}\n{back}"));
            let found = circles_by(&modules(&[LIB, facade, child, other]), |file| file);
            assert_eq!(found.len(), 1, "{back}: {found:?}");
            assert!(found[0].contains("film/child.rs -> film/other.rs (src/film/child.rs:2: "), "{found:?}");
            assert!(
                found[0].contains("film/other.rs -> film/child.rs (src/film/other.rs:1: super::work)"),
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_circle_of_files_by_way_of_a_folder_is_found() {
        let other = ("film/other.rs", "use super::deep::Shape; pub struct Other;");
        for folder in [
            "mod inner; pub struct Shape(super::other::Other); fn f() { inner::work() }",
            "mod inner; pub use super::other::Other; pub struct Shape(Other);",
        ] {
            let files = [LIB, ("film/mod.rs", "mod deep; mod other;"), ("film/deep/mod.rs", folder), other];
            let found = circles_by(&modules(&files), |file| file);
            assert_eq!(found.len(), 1, "{folder}: {found:?}");
        }
        // What a folder's files share may be in its `mod.rs`, which calls them.
        let deep = ("film/deep/mod.rs", "mod inner; pub struct Shape; fn f() { inner::work() }");
        let inner = ("film/deep/inner.rs", "use super::Shape; pub fn work(_: Shape) {}");
        assert_eq!(circles_by(&modules(&[LIB, deep, inner, other]), |file| file), Vec::<String>::new());
    }

    #[test]
    fn tests_may_import_what_they_like() {
        let film = ("film/mod.rs", "#[cfg(test)] mod tests; #[cfg(test)] mod more { use crate::sim::Sim; }");
        let found = modules(&[LIB, film, ("film/tests.rs", "use crate::sim::Sim;"), ("sim/mod.rs", "pub struct Sim;")]);
        assert_eq!(upward(&found), Vec::<String>::new());
    }

    #[test]
    fn the_engine_is_found_in_the_core() {
        let switched = "#[cfg_attr(feature = \"plugin\", derive(bevy::X))] struct S { #[cfg(feature = \"plugin\")] a: \
            bevy::A, b: bevy_math::Vec3 } #[cfg(feature = \"plugin\")] impl From<bevy::B> for S {} /* bevy::C */";
        assert_eq!(engine_names(&crate_of(&[("film/mod.rs", switched)])), Vec::<String>::new());
        let plain =
            format!("{switched}\n#[cfg_attr(feature = \"plugin\", derive(bevy::X))] fn f(_: bevy::ecs::Y) {{}}");
        assert_eq!(engine_names(&crate_of(&[("film/mod.rs", &plain)])), ["src/film/mod.rs:2: bevy"]);
        let files = [("api/mod.rs", "use bevy::ecs;"), ("settings/asset.rs", "use bevy::asset;")];
        assert_eq!(engine_names(&crate_of(&files)), Vec::<String>::new());
        assert_eq!(engine_names(&crate_of(&[("bake/mod.rs", "use bevy_mesh::Mesh;")])).len(), 1);
    }
}

/// Rooms whose results are the same on every machine, to the bit.
const TO_THE_BIT: [&str; 8] = ["film", "fracture", "deform", "stain", "sim", "touch", "surface", "remesh"];

/// Types of the maths library that add in another order where registers have four lanes, or divide otherwise.
const OF_REGISTERS: [&str; 5] = ["Quat", "Vec3A", "Mat3A", "Mat4", "Affine3A"];

/// File that multiplies and adds by components only, in the same order everywhere; what it inverts tells no more than
/// which blockers need not be looked at.
const IN_ORDER: &str = "stain/exposure/surface.rs";

#[test]
fn films_do_without_types_whose_bits_depend_on_registers() {
    let files = sources("src").into_iter().filter(|(file, _)| TO_THE_BIT.contains(&room(file)));
    let files = files.filter(|(file, _)| file != IN_ORDER && !file.ends_with("tests.rs") && !file.contains("tests/"));
    let mut found = Vec::new();
    for (file, source) in files {
        let code = source.split("#[cfg(test)]").next().expect("code");
        let lines = code.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"));
        for (i, line) in lines {
            let mut words = line.split(|c: char| !c.is_alphanumeric());
            found.extend(
                words.find(|word| OF_REGISTERS.contains(word)).map(|word| format!("src/{file}:{}: {word}", i + 1)),
            );
        }
    }
    assert_none(&found, "the bits of films do not depend on registers: see film/rotation.rs");
}
