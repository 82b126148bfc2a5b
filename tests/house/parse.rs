//! The modules of a file: what each imports, names by a path, and defines.

use std::collections::BTreeSet;

use crate::tokens::{Token, after_closing, begins_with, tokens, without_items};

/// Segments of a path, as written or from the root of the crate.
pub type Path = Vec<String>;

/// One name that a `use` brings into a module.
#[derive(Debug)]
pub struct Import {
    pub path: Path,
    /// What it is called here; `*` for all names.
    pub name: String,
    /// Whether it has any visibility: `pub`, `pub(crate)` and so on.
    pub is_public: bool,
    pub line: usize,
}

/// A module with a file of its own or within one.
#[derive(Debug, Default)]
pub struct Module {
    /// From the root of the crate.
    pub path: Path,
    /// Index of its file.
    pub file: usize,
    pub imports: Vec<Import>,
    /// Paths of two segments or more that occur outside of `use`.
    pub paths: Vec<(Path, usize)>,
    pub defined: BTreeSet<String>,
    /// Every word outside of `use`.
    pub words: BTreeSet<String>,
}

/// Words that are followed by the name of what they define.
const DEFINING: [&str; 10] =
    ["fn", "struct", "enum", "trait", "type", "const", "static", "union", "mod", "macro_rules"];

/// Returns whether an attribute keeps its item for tests.
pub fn is_test(attribute: &[Token]) -> bool {
    begins_with(attribute, &["cfg", "(", "test", ")"]) || begins_with(attribute, &["cfg", "(", "all", "(", "test"])
}

/// Reads a file as the module at `path`. Modules of tests are left out; those that lie in other files are returned by
/// their paths.
pub fn parse(file: usize, path: &Path, source: &str) -> (Vec<Module>, Vec<Path>) {
    let (tokens, dropped) = without_items(&tokens(source), is_test);
    let tests = dropped.iter().filter_map(|item| {
        let name = item.windows(3).find(|w| w[0].is("mod") && w[2].is(";"))?[1].text.clone();
        Some([path.clone(), vec![name]].concat())
    });
    let mut modules = vec![Module { path: path.clone(), file, ..Module::default() }];
    read(&tokens, 0, &mut modules);
    (modules, tests.collect())
}

/// Reads the tokens of `modules[at]`, and appends the modules within.
fn read(tokens: &[Token], at: usize, modules: &mut Vec<Module>) {
    let mut i = 0;
    let mut is_public = false;
    let is = |i: usize, text: &str| tokens.get(i).is_some_and(|t| t.is(text));
    while let Some(token) = tokens.get(i) {
        let module = &mut modules[at];
        if token.is("pub") {
            is_public = true;
            i = if is(i + 1, "(") { after_closing(tokens, i + 1) } else { i + 1 };
            continue;
        }
        if token.is("use") && !is(i + 1, "<") {
            let end = i + tokens[i..].iter().position(|t| t.is(";")).unwrap_or(tokens.len() - i);
            read_tree(&tokens[i + 1..end], &[], is_public, &mut module.imports);
            i = end;
        } else if token.is("mod") && is(i + 2, "{") {
            let end = after_closing(tokens, i + 2);
            let path = [module.path.clone(), vec![tokens[i + 1].text.clone()]].concat();
            let file = module.file;
            modules.push(Module { path, file, ..Module::default() });
            let inner = modules.len() - 1;
            read(&tokens[i + 3..end - 1], inner, modules);
            i = end;
        } else if token.is_word() {
            if DEFINING.contains(&token.text.as_str())
                && let Some(name) = tokens[i + 1..].iter().find(|t| t.is_word())
            {
                module.defined.insert(name.text.clone());
            }
            let mut path = vec![token.text.clone()];
            let mut end = i + 1;
            while is(end, "::") && tokens.get(end + 1).is_some_and(Token::is_word) {
                path.push(tokens[end + 1].text.clone());
                end += 2;
            }
            module.words.insert(path[0].clone());
            if path.len() > 1 {
                module.paths.push((path, token.line));
            }
            i = end;
        } else {
            i += 1;
        }
        is_public = false;
    }
}

/// Reads what follows `use`, below the segments in `prefix`.
fn read_tree(tokens: &[Token], prefix: &[String], is_public: bool, imports: &mut Vec<Import>) {
    let mut path = prefix.to_vec();
    let mut i = 0;
    while let Some(token) = tokens.get(i) {
        match token.text.as_str() {
            "{" => {
                let end = after_closing(tokens, i);
                let mut start = i + 1;
                while start < end - 1 {
                    let length = branch_length(&tokens[start..end - 1]);
                    read_tree(&tokens[start..start + length], &path, is_public, imports);
                    start += length + 1;
                }
                return;
            }
            "as" => break,
            "::" => {}
            _ => path.push(token.text.clone()),
        }
        i += 1;
    }
    let Some(first) = tokens.first() else { return };
    let alias = tokens.get(i + 1).map(|t| t.text.clone());
    if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
        path.pop();
    }
    let name = alias.or_else(|| path.last().cloned()).unwrap_or_default();
    if name == "*" {
        path.pop();
    }
    imports.push(Import { path, name, is_public, line: first.line });
}

/// Number of tokens up to the comma that ends this branch of a tree.
fn branch_length(tokens: &[Token]) -> usize {
    let mut i = 0;
    while i < tokens.len() && !tokens[i].is(",") {
        i = if tokens[i].is("{") { after_closing(tokens, i) } else { i + 1 };
    }
    i
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uses_are_read_with_nested_braces_and_other_names() {
        let source = "pub(crate) use crate::{a::{self, B as C, d::*}, e::F}; use super::super::g;\
            use self::h::i as j; fn f() -> impl Fn() + use<> { use k::L; }";
        let (modules, _) = parse(0, &vec!["m".to_owned()], source);
        let read: Vec<String> = modules[0]
            .imports
            .iter()
            .map(|u| format!("{}{} as {}", if u.is_public { "pub " } else { "" }, u.path.join("::"), u.name))
            .collect();
        assert_eq!(
            read,
            [
                "pub crate::a as a",
                "pub crate::a::B as C",
                "pub crate::a::d as *",
                "pub crate::e::F as F",
                "super::super::g as g",
                "self::h::i as j",
                "k::L as L"
            ]
        );
    }

    #[test]
    fn paths_are_read_outside_of_use_but_neither_in_tests_nor_in_visibilities() {
        let source = "mod inner { pub(in crate::no) fn f(x: super::A) { crate::b::c(); } } #[cfg(test)] mod tests;
            #[cfg(test)] mod more { fn g() { crate::no(); } } struct S; // crate::no";
        let (modules, tests) = parse(3, &vec!["m".to_owned()], source);
        assert_eq!(tests, [["m", "tests"]]);
        assert_eq!(modules.len(), 2);
        assert_eq!((modules[1].path.join("::").as_str(), modules[1].file), ("m::inner", 3));
        let paths: Vec<String> = modules[1].paths.iter().map(|(path, _)| path.join("::")).collect();
        assert_eq!(paths, ["super::A", "crate::b::c"]);
        assert!(modules[0].paths.is_empty() && modules[0].defined.contains("S"));
    }
}
