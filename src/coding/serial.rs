//! Reads strings of bytes as serde data.

use std::fmt;

use serde::{Deserializer, de};

/// Bytes that are set aside at most before any has come: formats may say any number.
const AHEAD: usize = 1 << 16;

/// Reads a string of bytes; of formats without bytes, such as JSON, a list of numbers. `what` names them in errors.
pub(crate) fn deserialize_bytes<'de, D: Deserializer<'de>>(
    deserializer: D,
    what: &'static str,
) -> Result<Vec<u8>, D::Error> {
    deserializer.deserialize_byte_buf(Bytes(what))
}

struct Bytes(&'static str);

impl<'de> de::Visitor<'de> for Bytes {
    type Value = Vec<u8>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_bytes<E: de::Error>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
        Ok(bytes.to_vec())
    }

    fn visit_byte_buf<E: de::Error>(self, bytes: Vec<u8>) -> Result<Vec<u8>, E> {
        Ok(bytes)
    }

    fn visit_seq<A: de::SeqAccess<'de>>(self, mut list: A) -> Result<Vec<u8>, A::Error> {
        let mut bytes = Vec::with_capacity(list.size_hint().unwrap_or_default().min(AHEAD));
        while let Some(byte) = list.next_element()? {
            bytes.push(byte);
        }
        Ok(bytes)
    }
}
