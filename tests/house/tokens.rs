//! Rust source as words and signs, without comments; and items that an attribute takes out.

/// A word, a literal or a sign. `::` is one sign; texts are kept in their quotes, lifetimes are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    pub text: String,
    pub line: usize,
}

impl Token {
    pub fn is(&self, text: &str) -> bool {
        self.text == text
    }

    pub fn is_word(&self) -> bool {
        self.text.starts_with(|c: char| c.is_alphabetic() || c == '_')
    }
}

pub fn tokens(source: &str) -> Vec<Token> {
    let chars: Vec<char> = source.chars().collect();
    let (mut found, mut i, mut line) = (Vec::new(), 0, 1);
    while i < chars.len() {
        let rest = &chars[i..];
        let (length, kept) = if let Some(length) = comment(rest).or_else(|| lifetime(rest)) {
            (length, false)
        } else if let Some(length) = literal(rest) {
            (length, true)
        } else if rest[0].is_alphanumeric() || rest[0] == '_' {
            (rest.iter().take_while(|&&c| c.is_alphanumeric() || c == '_').count(), true)
        } else if rest.starts_with(&[':', ':']) {
            (2, true)
        } else {
            (1, !rest[0].is_whitespace())
        };
        if kept {
            found.push(Token { text: rest[..length].iter().collect(), line });
        }
        line += rest[..length].iter().filter(|&&c| c == '\n').count();
        i += length;
    }
    found
}

/// Length of a comment that begins here.
fn comment(rest: &[char]) -> Option<usize> {
    if rest.starts_with(&['/', '/']) {
        return Some(rest.iter().take_while(|&&c| c != '\n').count());
    }
    let (mut depth, mut i) = (0, 0);
    while i < rest.len() {
        match (rest[i], rest.get(i + 1)) {
            ('/', Some('*')) => depth += 1,
            ('*', Some('/')) => depth -= 1,
            _ if depth == 0 => return None,
            _ => {
                i += 1;
                continue;
            }
        }
        i += 2;
        if depth == 0 {
            return Some(i);
        }
    }
    None
}

/// Length of a lifetime that begins here; `'a'` is a character.
fn lifetime(rest: &[char]) -> Option<usize> {
    let name = rest.strip_prefix(&['\''])?.iter().take_while(|&&c| c.is_alphanumeric() || c == '_').count();
    (name > 0 && rest.get(name + 1) != Some(&'\'')).then_some(name + 1)
}

/// Length of a character, a text or a raw text that begins here.
fn literal(rest: &[char]) -> Option<usize> {
    let prefix = rest.iter().take_while(|c| "bcr".contains(**c)).count();
    let raw = rest[..prefix].contains(&'r');
    let fences = if raw { rest[prefix..].iter().take_while(|&&c| c == '#').count() } else { 0 };
    let mut i = prefix + fences;
    let quote = *rest.get(i).filter(|&&c| prefix <= 2 && (c == '"' || c == '\'' && fences == 0))?;
    loop {
        i += 1;
        match rest.get(i)? {
            '\\' if !raw => i += 1,
            c if *c == quote && rest[i + 1..].iter().take_while(|&&c| c == '#').count() >= fences => {
                return Some(i + 1 + fences);
            }
            _ => {}
        }
    }
}

/// Index after the bracket that closes the one at `open`.
pub fn after_closing(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0usize;
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => {
                depth -= 1;
                if depth == 0 {
                    return i + 1;
                }
            }
            _ => {}
        }
    }
    tokens.len()
}

/// Words that begin an item or a statement; what begins otherwise (a field, a variant, a parameter) ends at a comma.
const ITEMS: [&str; 16] = [
    "fn",
    "use",
    "mod",
    "struct",
    "enum",
    "impl",
    "trait",
    "const",
    "static",
    "type",
    "unsafe",
    "extern",
    "async",
    "let",
    "macro_rules",
    "union",
];

/// Index after the item, field or statement that begins at `start`, past its own attributes.
fn after_item(tokens: &[Token], start: usize) -> usize {
    let mut i = start;
    while tokens.get(i).is_some_and(|t| t.is("#")) {
        i = after_closing(tokens, i + 1);
    }
    let mut first = i;
    if tokens.get(first).is_some_and(|t| t.is("pub")) {
        first += 1;
        if tokens.get(first).is_some_and(|t| t.is("(")) {
            first = after_closing(tokens, first);
        }
    }
    let comma_ends = !tokens.get(first).is_some_and(|t| ITEMS.contains(&t.text.as_str()));
    while i < tokens.len() {
        match tokens[i].text.as_str() {
            ";" => return i + 1,
            "," if comma_ends => return i + 1,
            "{" => return after_closing(tokens, i),
            "(" | "[" => i = after_closing(tokens, i),
            ")" | "]" | "}" => return i,
            _ => i += 1,
        }
    }
    i
}

/// Drops each item that has an attribute for which `takes_out` holds, and gives the items that were dropped. An inner
/// attribute of the file takes all of it.
pub fn without_items(tokens: &[Token], takes_out: impl Fn(&[Token]) -> bool) -> (Vec<Token>, Vec<Vec<Token>>) {
    let (mut kept, mut dropped, mut i) = (Vec::new(), Vec::new(), 0);
    while i < tokens.len() {
        let inner = tokens.get(i + 1).is_some_and(|t| t.is("!"));
        let open = i + 1 + usize::from(inner);
        if tokens[i].is("#") && tokens.get(open).is_some_and(|t| t.is("[")) {
            let end = after_closing(tokens, open);
            if takes_out(&tokens[open + 1..end - 1]) {
                if inner {
                    return (Vec::new(), vec![tokens.to_vec()]);
                }
                let next = after_item(tokens, end);
                dropped.push(tokens[end..next].to_vec());
                i = next;
                continue;
            }
            kept.extend_from_slice(&tokens[i..end]);
            i = end;
        } else {
            kept.push(tokens[i].clone());
            i += 1;
        }
    }
    (kept, dropped)
}

/// Returns whether an attribute begins with these words and signs.
pub fn begins_with(attribute: &[Token], words: &[&str]) -> bool {
    attribute.len() >= words.len() && attribute.iter().zip(words).all(|(token, word)| token.is(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(source: &str) -> Vec<String> {
        tokens(source).into_iter().map(|token| token.text).collect()
    }

    #[test]
    fn comments_and_lifetimes_go_and_texts_stay_whole() {
        assert_eq!(words("a::b // c::d\n/* e /* f */ g */ 'x' &'a h"), ["a", "::", "b", "'x'", "&", "h"]);
        assert_eq!(
            words(r##"r"\" r#"a "quoted" use"# b'\'' "a\"b" rest"##),
            [r#"r"\""#, r##"r#"a "quoted" use"#"##, r"b'\''", r#""a\"b""#, "rest"]
        );
        let lines: Vec<usize> = tokens("a\n/* \n */ b\n\"\n\" c").iter().map(|token| token.line).collect();
        assert_eq!(lines, [1, 3, 4, 5]);
    }

    #[test]
    fn items_go_with_their_attribute() {
        let source = "#[cfg(test)] #[path = \"a\"] mod t { use x; } struct S { #[cfg(test)] a: A<B>, b: C }
            #[cfg(test)] fn f<A, B>(a: [A; 2]) -> B { g() } #[cfg(test)] use a::{b, c}; fn kept() {}";
        let (kept, dropped) = without_items(&tokens(source), |a| begins_with(a, &["cfg", "(", "test", ")"]));
        let kept: Vec<&str> = kept.iter().map(|token| token.text.as_str()).collect();
        assert_eq!(kept.join(" "), "struct S { b : C } ; fn kept ( ) { }");
        assert_eq!(dropped.len(), 4);
    }
}
