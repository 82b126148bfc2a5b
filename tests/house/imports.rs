//! Arrows from file to file.
//!
//! An arrow leads from a file that names something to the file that defines it. Names are followed through the imports
//! of the modules in between, so that a facade (`pub use child::Name` in a `mod.rs`) is no detour. Not counted are
//!
//! - declarations of modules: a parent does not depend on its children;
//! - a module's public re-exports of what lies below it, unless it uses the name itself;
//! - an import of a whole module, where its names are used by `module::name`: these count;
//! - comments and tests.

use std::collections::BTreeMap;

use crate::{
    Source,
    parse::{Import, Module, Path, parse},
};

/// Facades of facades are followed this far.
const MOST_DETOURS: usize = 8;

/// An import, or a path in the code.
#[derive(Clone, Debug)]
pub struct Arrow {
    /// Index of the file that names something.
    pub from: usize,
    /// Index of the file that defines it.
    pub to: usize,
    /// The module by which it is named: another than `to` where that module re-exports it.
    pub by: Path,
    pub line: usize,
    /// The path as written.
    pub written: String,
}

/// The modules of a crate.
pub struct Modules {
    pub files: Vec<String>,
    modules: BTreeMap<Path, Module>,
}

impl Modules {
    /// Reads the files of a `src` folder. Programs beside the library (`main.rs`, `bin/`) are no part of it.
    pub fn new(sources: &[Source]) -> Self {
        let (mut modules, mut tests) = (BTreeMap::new(), Vec::new());
        for (file, (name, source)) in sources.iter().enumerate() {
            if name == "main.rs" || name.starts_with("bin/") {
                continue;
            }
            let (found, found_tests) = parse(file, &module_path(name), source);
            modules.extend(found.into_iter().map(|module| (module.path.clone(), module)));
            tests.extend(found_tests);
        }
        modules.retain(|path, _| !tests.iter().any(|test| path.starts_with(test)));
        Self { files: sources.iter().map(|(name, _)| name.clone()).collect(), modules }
    }

    /// All arrows between different files.
    pub fn arrows(&self) -> Vec<Arrow> {
        let mut arrows = Vec::new();
        for module in self.modules.values() {
            for import in &module.imports {
                if self.is_counted(module, import) {
                    self.point(module, &import.path, import.name == "*", import.line, &mut arrows);
                }
            }
            for (path, line) in &module.paths {
                self.point(module, path, false, *line, &mut arrows);
            }
        }
        arrows
    }

    /// Appends the arrow from `module` along `path`, if that leads to another file of the crate.
    fn point(&self, module: &Module, path: &Path, all: bool, line: usize, arrows: &mut Vec<Arrow>) {
        let Some(absolute) = self.absolute(module, path, 0) else { return };
        let (by, name) = self.locate(&absolute);
        let target = match name {
            Some(name) if !all => self.definition(by, name, 0),
            _ => by,
        };
        if target.file != module.file || by.file != module.file {
            let (from, to, by) = (module.file, target.file, by.path.clone());
            arrows.push(Arrow { from, to, by, line, written: path.join("::") });
        }
    }

    fn is_counted(&self, module: &Module, import: &Import) -> bool {
        let Some(absolute) = self.absolute(module, &import.path, 0) else { return false };
        let (by, name) = self.locate(&absolute);
        if import.is_public && by.path.len() > module.path.len() && by.path.starts_with(&module.path) {
            return module.words.contains(&import.name);
        }
        let is_module = name.is_none() && import.name != "*";
        !(is_module && module.paths.iter().any(|(path, _)| path[0] == import.name))
    }

    /// The path from the root of the crate; `None` where it leads out of the crate or is none of a module.
    fn absolute(&self, module: &Module, path: &Path, detours: usize) -> Option<Path> {
        let mut base = module.path.clone();
        let mut rest = path.as_slice();
        match rest.first()?.as_str() {
            "crate" => (base, rest) = (Vec::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|segment| segment == "super") {
                    base.pop()?;
                    rest = &rest[1..];
                }
            }
            first => {
                let child = [base.clone(), vec![first.to_owned()]].concat();
                if !self.modules.contains_key(&child) {
                    // A module that was imported; names that were are counted by their import.
                    let is_it = |import: &&Import| import.name == *first && import.path.len() > 1;
                    let import = module.imports.iter().find(is_it).filter(|_| detours < MOST_DETOURS)?;
                    base = self.absolute(module, &import.path, detours + 1)?;
                    if !self.modules.contains_key(&base) {
                        return None;
                    }
                    rest = &rest[1..];
                }
            }
        }
        Some([base, rest.to_vec()].concat())
    }

    /// The innermost module on a path from the root, and the name in it that the path goes on with.
    fn locate<'a>(&self, absolute: &'a [String]) -> (&Module, Option<&'a str>) {
        let known = |length: &usize| self.modules.contains_key(&absolute[..*length]);
        let length = (0..=absolute.len()).rev().find(known).expect("the root is a module");
        (&self.modules[&absolute[..length]], absolute.get(length).map(String::as_str))
    }

    /// The module that defines a name of `module`: itself, unless it imports the name.
    fn definition<'a>(&'a self, module: &'a Module, name: &str, detours: usize) -> &'a Module {
        if module.defined.contains(name) || detours == MOST_DETOURS {
            return module;
        }
        let follow = |import: &Import| -> Option<&Module> {
            let (by, found) = self.locate_import(module, import)?;
            Some(found.map_or(by, |found| self.definition(by, &found, detours + 1)))
        };
        if let Some(found) = module.imports.iter().find(|import| import.name == name).and_then(follow) {
            return found;
        }
        let globs = module.imports.iter().filter(|import| import.name == "*" && import.is_public);
        globs
            .filter_map(|import| self.locate_import(module, import))
            .map(|(by, _)| self.definition(by, name, detours + 1))
            .find(|found| found.defined.contains(name))
            .unwrap_or(module)
    }

    fn locate_import(&self, module: &Module, import: &Import) -> Option<(&Module, Option<String>)> {
        let absolute = self.absolute(module, &import.path, 0)?;
        let (by, name) = self.locate(&absolute);
        Some((by, name.map(str::to_owned)))
    }
}

/// Path of the module that a file of `src` holds.
fn module_path(file: &str) -> Path {
    let name = file.trim_end_matches(".rs").trim_end_matches("/mod");
    if matches!(name, "lib" | "mod") { Vec::new() } else { name.split('/').map(str::to_owned).collect() }
}
