//! Snapshots as serde data: one string of bytes.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use super::film_snapshot::Snapshot;
use crate::coding::deserialize_bytes;

impl Serialize for Snapshot {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.as_bytes())
    }
}

impl<'de> Deserialize<'de> for Snapshot {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let bytes = deserialize_bytes(deserializer, "the bytes of a snapshot")?;
        Self::from_bytes(bytes).map_err(D::Error::custom)
    }
}
