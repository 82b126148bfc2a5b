//! Takes the file around a glTF document apart: chunks of a .glb, buffers and URIs.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
};

use base64::{
    Engine, alphabet,
    engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig},
};

use serde_json::{Map, Value};

use super::{
    GltfError,
    document::{Document, lookup},
    extensions,
};
use crate::{bake::carried::Carried, files};

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";

/// A document and its buffers.
#[derive(Debug)]
pub struct Container<'a> {
    pub document: Document,
    /// All of the JSON, for what ageing does not change.
    pub root: Map<String, Value>,
    folder: Option<&'a Path>,
    buffers: Vec<Cow<'a, [u8]>>,
}

impl<'a> Container<'a> {
    /// Takes a file apart and loads its buffers.
    pub fn open(bytes: &'a [u8], folder: Option<&'a Path>) -> Result<Self, GltfError> {
        let (json, binary) = if bytes.starts_with(MAGIC) { split_glb(bytes)? } else { (bytes, None) };
        let text = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        if text.iter().find(|c| !c.is_ascii_whitespace()) != Some(&b'{') {
            return Err(GltfError::NotGltf);
        }
        let document: Document = serde_json::from_slice(text).map_err(GltfError::Json)?;
        if document.asset.version.split('.').next() != Some("2") {
            return Err(GltfError::Version(document.asset.version));
        }
        // Before buffers are read: compressed files often have one that is no data.
        extensions::check(&document.extensions_required)?;
        let root = serde_json::from_slice(text).map_err(GltfError::Json)?;
        let mut container = Self { document, root, folder, buffers: Vec::new() };
        for (i, buffer) in container.document.buffers.iter().enumerate() {
            let what = format!("buffer {i}");
            let bytes = match (&buffer.uri, binary) {
                (Some(uri), _) => Cow::Owned(container.load_uri(uri, &what)?.0),
                (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
                (None, _) => Cow::Borrowed(&[][..]),
            };
            let found = bytes.len() as u64;
            if found < buffer.byte_length {
                return Err(GltfError::Truncated { what, needed: buffer.byte_length, found });
            }
            container.buffers.push(bytes);
        }
        Ok(container)
    }

    /// The number of bytes of all buffers.
    pub fn bytes(&self) -> u64 {
        self.buffers.iter().map(|buffer| buffer.len() as u64).sum()
    }

    /// All of the JSON and the buffers.
    pub fn into_carried(self) -> Carried {
        Carried { root: self.root, buffers: self.buffers.into_iter().map(|bytes| bytes.into_owned().into()).collect() }
    }

    /// The bytes of a buffer view.
    pub fn view(&self, index: usize, from: &str) -> Result<&[u8], GltfError> {
        let view = lookup(&self.document.buffer_views, index, "buffer view", from)?;
        let what = format!("buffer view {index}");
        let buffer = lookup(&self.buffers, view.buffer, "buffer", &what)?;
        let end = view.byte_offset.saturating_add(view.byte_length);
        usize::try_from(view.byte_offset)
            .ok()
            .zip(usize::try_from(end).ok())
            .and_then(|(start, end)| buffer.get(start..end))
            .ok_or(GltfError::Truncated { what, needed: end, found: buffer.len() as u64 })
    }

    /// The bytes behind a URI, and its media type if it is a data URI.
    pub fn load_uri(&self, uri: &str, what: &str) -> Result<(Vec<u8>, Option<String>), GltfError> {
        let shown =
            || if uri.len() > 60 { uri.chars().take(60).chain("...".chars()).collect() } else { uri.to_owned() };
        let fail = |cause: String| GltfError::External { what: what.into(), uri: shown(), cause };
        if let Some(data) = uri.strip_prefix("data:") {
            let (header, payload) = data.split_once(',').ok_or_else(|| fail("it has no data".into()))?;
            let (media, base64) = match header.strip_suffix(";base64") {
                Some(media) => (media, true),
                None => (header, false),
            };
            let payload = percent_decode(payload);
            let bytes =
                if base64 { decode_base64(payload).ok_or_else(|| fail("it is no base64".into()))? } else { payload };
            let media = media.split(';').next().filter(|media| !media.is_empty());
            return Ok((bytes, media.map(str::to_owned)));
        }
        let relative = relative_path(uri).ok_or_else(|| fail("it is no relative path".into()))?;
        let folder = self.folder.ok_or_else(|| fail("it is a file of its own, and the model is none".into()))?;
        let path = folder.join(relative);
        let bytes = files::read(&path).map_err(|error| fail(error.to_string()))?;
        Ok((bytes, None))
    }

    /// Files that the document refers to.
    pub fn files(&self) -> Vec<PathBuf> {
        let Some(folder) = self.folder else { return Vec::new() };
        let buffers = self.document.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
        let images = self.document.images.iter().filter_map(|image| image.uri.as_deref());
        buffers.chain(images).filter_map(relative_path).map(|path| folder.join(path)).collect()
    }
}

/// The path of a file of its own; `None` for other addresses.
fn relative_path(uri: &str) -> Option<PathBuf> {
    // Paths have no scheme.
    let is_path = !uri.contains("://") && !uri.starts_with("data:");
    String::from_utf8(percent_decode(uri)).ok().filter(|_| is_path).and_then(|path| files::relative(&path))
}

/// JSON and binary chunk of a .glb.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    let truncated = |what: &str, needed: usize| GltfError::Truncated {
        what: what.into(),
        needed: needed as u64,
        found: bytes.len() as u64,
    };
    let word = |at: usize| -> Option<u32> { Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?)) };
    let (version, length) = word(4).zip(word(8)).ok_or_else(|| truncated("the header", 12))?;
    if version != 2 {
        return Err(GltfError::Version(version.to_string()));
    }
    let end = length as usize;
    if end > bytes.len() {
        return Err(truncated("the file", end));
    }
    let (mut json, mut binary, mut at) = (None, None, 12usize);
    while at + 8 <= end {
        let size = word(at).unwrap_or(0) as usize;
        let kind = bytes.get(at + 4..at + 8).unwrap_or_default();
        let (start, stop) = (at + 8, (at + 8).saturating_add(size));
        let chunk = bytes.get(start..stop).ok_or_else(|| truncated("a chunk", stop))?;
        match (kind, json) {
            (JSON_CHUNK, None) => json = Some(chunk),
            (_, None) => return Err(GltfError::NoJson),
            (BINARY_CHUNK, Some(_)) if binary.is_none() => binary = Some(chunk),
            // Unknown chunks are to be ignored.
            _ => {}
        }
        at = stop.div_ceil(4) * 4;
    }
    Ok((json.ok_or_else(|| truncated("the JSON chunk", 20))?, binary))
}

/// Decodes base64 (RFC 4648, section 4) as files have it: white space is skipped, padding may be missing, and the bits
/// after the last byte do not matter. `None` if it is no base64.
fn decode_base64(mut text: Vec<u8>) -> Option<Vec<u8>> {
    const LENIENT: GeneralPurpose = GeneralPurpose::new(
        &alphabet::STANDARD,
        GeneralPurposeConfig::new()
            .with_decode_allow_trailing_bits(true)
            .with_decode_padding_mode(DecodePaddingMode::RequireNone),
    );
    text.retain(|c| !c.is_ascii_whitespace());
    let length = text.iter().rposition(|&c| c != b'=').map_or(0, |last| last + 1);
    text.truncate(length);
    LENIENT.decode(text).ok()
}

/// Replaces `%20` and the like. What is no such code stays as it is.
fn percent_decode(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let (mut out, mut i) = (Vec::with_capacity(bytes.len()), 0);
    while let Some(&c) = bytes.get(i) {
        let code = bytes
            .get(i + 1..i + 3)
            .filter(|code| c == b'%' && code.iter().all(u8::is_ascii_hexdigit))
            .and_then(|code| std::str::from_utf8(code).ok())
            .and_then(|code| u8::from_str_radix(code, 16).ok());
        out.push(code.unwrap_or(c));
        i += if code.is_some() { 3 } else { 1 };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_may_lack_padding_and_have_white_space() {
        for (text, bytes) in [
            ("", Some(&b""[..])),
            ("====", Some(b"")),
            ("aGVsbG8=", Some(b"hello")),
            ("aGVs\n bG8", Some(b"hello")),
            ("aGVsbG9=", Some(b"hello")),
            ("aGVsbG8==", Some(b"hello")),
            ("+/+/", Some(b"\xfb\xff\xbf")),
            ("a", None),
            ("aGVsb", None),
            ("aGVs=bG8", None),
            ("aGVs-G8=", None),
            ("aGVs\u{e9}", None),
        ] {
            assert_eq!(decode_base64(text.into()).as_deref(), bytes, "{text:?}");
        }
    }
}
