//! Holds the document that a model was read from, for all that ageing does not change.

use std::sync::Arc;

use serde_json::{Map, Value};

/// The glTF document that a model was read from, with its buffers. The aged model begins with it, so that everything
/// that ageing does not touch goes on as it is: nodes, animations, cameras, lights, extras, extensions, names. It is
/// empty where a model was read from something else.
#[derive(Clone, Debug, Default)]
pub struct Carried {
    /// The root object. Materials, textures, samplers and images are taken from the model's library instead.
    pub(super) root: Map<String, Value>,
    /// Buffers, each at least as long as the document says.
    pub(super) buffers: Vec<Arc<[u8]>>,
}

impl Carried {
    /// Returns element `index` of one of the root's lists; null if there is none.
    pub(super) fn element(&self, list: &str, index: usize) -> &Value {
        self.root.get(list).and_then(|list| list.get(index)).unwrap_or(&Value::Null)
    }
}
