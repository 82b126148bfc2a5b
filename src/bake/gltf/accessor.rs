//! Reads accessors: strided, sparse, normalised, of any component type, and all of it checked.

use super::{
    GltfError,
    container::Container,
    document::{Accessor, lookup},
};

/// Most elements an accessor may have. Far above any prop; an accessor without a buffer view could claim
/// 2^53 elements in a file of 200 bytes.
const MAX_ELEMENTS: usize = 1 << 24;

/// Component types of glTF 2.0, section 3.6.2.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn new(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the start of `bytes`, which holds at least [`Self::size`].
    fn float(self, bytes: &[u8], normalized: bool) -> f32 {
        let (value, most) = match self {
            Self::I8 => (f32::from(i8::from_le_bytes(first(bytes))), 127.0),
            Self::U8 => (f32::from(u8::from_le_bytes(first(bytes))), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes(first(bytes))), 32767.0),
            Self::U16 => (f32::from(u16::from_le_bytes(first(bytes))), 65535.0),
            Self::U32 => return self.index(bytes) as f32,
            Self::F32 => return f32::from_le_bytes(first(bytes)),
        };
        if normalized { (value / most).max(-1.0) } else { value }
    }

    fn index(self, bytes: &[u8]) -> u32 {
        match self {
            Self::U8 => u32::from(u8::from_le_bytes(first(bytes))),
            Self::U16 => u32::from(u16::from_le_bytes(first(bytes))),
            _ => u32::from_le_bytes(first(bytes)),
        }
    }

    fn is_index(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }
}

/// The first `N` bytes; zeros if there are fewer.
fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
    bytes.first_chunk().copied().unwrap_or([0; N])
}

impl Container<'_> {
    /// Checks that an accessor lies in its buffer views, those of matrices too.
    pub fn check_accessor(&self, index: usize) -> Result<(), GltfError> {
        let from = format!("accessor {index}");
        let accessor = lookup(&self.document.accessors, index, "accessor", &from)?;
        let fail = |cause: String| GltfError::Accessor { accessor: index, what: "read", cause };
        let component = Component::new(accessor.component_type)
            .ok_or_else(|| fail(format!("component type {} does not exist", accessor.component_type)))?;
        // Columns of matrices begin at multiples of four bytes.
        let columns =
            |count: usize| (count * component.size()).next_multiple_of(4) * (count - 1) + count * component.size();
        let size = match accessor.r#type.as_str() {
            "SCALAR" => component.size(),
            "VEC2" => component.size() * 2,
            "VEC3" => component.size() * 3,
            "VEC4" => component.size() * 4,
            "MAT2" => columns(2),
            "MAT3" => columns(3),
            "MAT4" => columns(4),
            other => return Err(fail(format!("its type is {other}"))),
        };
        let inside = |view: usize, offset: u64, strided: bool, size: usize, count: u64| {
            let own = lookup(&self.document.buffer_views, view, "buffer view", &from)?;
            let stride = own.byte_stride.filter(|_| strided).unwrap_or(size as u64);
            let before = count.saturating_sub(1).saturating_mul(stride);
            let needed = if count == 0 { 0 } else { before.saturating_add(offset).saturating_add(size as u64) };
            let found = self.view(view, &from)?.len() as u64;
            if needed > found {
                return Err(GltfError::Truncated { what: from.clone(), needed, found });
            }
            Ok(())
        };
        if let Some(view) = accessor.buffer_view {
            inside(view, accessor.byte_offset, true, size, accessor.count)?;
        }
        if let Some(sparse) = &accessor.sparse {
            let component = Component::new(sparse.indices.component_type)
                .ok_or_else(|| fail("its sparse indices are no unsigned integers".into()))?;
            inside(sparse.indices.buffer_view, sparse.indices.byte_offset, false, component.size(), sparse.count)?;
            inside(sparse.values.buffer_view, sparse.values.byte_offset, false, size, sparse.count)?;
        }
        Ok(())
    }

    /// Vectors of exactly `N` components.
    pub fn vectors<const N: usize>(&self, index: usize, what: &'static str) -> Result<Vec<[f32; N]>, GltfError> {
        let reader = Reader::new(self, index, what)?;
        if reader.width != N {
            return Err(reader.fail(format!("it is {}, not VEC{N}", reader.accessor.r#type)));
        }
        if reader.component == Component::U32 {
            return Err(reader.fail("its components are 32-bit integers".into()));
        }
        reader.collect([0.0; N], |bytes| {
            let size = reader.component.size();
            let from = |i: usize| bytes.get(i * size..).unwrap_or_default();
            std::array::from_fn(|i| reader.component.float(from(i), reader.accessor.normalized))
        })
    }

    /// Colours with or without alpha, as red, green, blue, alpha.
    pub fn colors(&self, index: usize) -> Result<Vec<[f32; 4]>, GltfError> {
        let what = "vertex colours";
        let accessor = lookup(&self.document.accessors, index, "accessor", what)?;
        if accessor.r#type == "VEC3" {
            let colors = self.vectors::<3>(index, what)?;
            return Ok(colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect());
        }
        self.vectors::<4>(index, what)
    }

    /// Vertex indices.
    pub fn indices(&self, index: usize) -> Result<Vec<u32>, GltfError> {
        let reader = Reader::new(self, index, "indices")?;
        if reader.width != 1 || !reader.component.is_index() {
            return Err(reader.fail("it holds no unsigned integers".into()));
        }
        reader.collect(0, |bytes| reader.component.index(bytes))
    }
}

/// An accessor about to be read.
struct Reader<'a> {
    container: &'a Container<'a>,
    accessor: &'a Accessor,
    index: usize,
    what: &'static str,
    component: Component,
    /// Number of elements.
    count: usize,
    /// Components an element.
    width: usize,
}

impl<'a> Reader<'a> {
    fn new(container: &'a Container<'a>, index: usize, what: &'static str) -> Result<Self, GltfError> {
        let accessor = lookup(&container.document.accessors, index, "accessor", what)?;
        let fail = |cause: String| GltfError::Accessor { accessor: index, what, cause };
        let component = Component::new(accessor.component_type)
            .ok_or_else(|| fail(format!("component type {} does not exist", accessor.component_type)))?;
        let width = match accessor.r#type.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            other => return Err(fail(format!("its type is {other}"))),
        };
        let Some(count) = usize::try_from(accessor.count).ok().filter(|&count| count <= MAX_ELEMENTS) else {
            let what = format!("accessor {index}");
            return Err(GltfError::TooMany { what, found: accessor.count, limit: MAX_ELEMENTS as u64 });
        };
        Ok(Self { container, accessor, index, what, component, count, width })
    }

    fn fail(&self, cause: String) -> GltfError {
        GltfError::Accessor { accessor: self.index, what: self.what, cause }
    }

    /// Reads all elements; those that no buffer view gives are `zero`.
    fn collect<T: Copy>(&self, zero: T, read: impl Fn(&[u8]) -> T) -> Result<Vec<T>, GltfError> {
        let from = format!("accessor {}", self.index);
        let count = self.count;
        let size = self.component.size() * self.width;
        let mut elements = match self.accessor.buffer_view {
            Some(view) => {
                let stride = lookup(&self.container.document.buffer_views, view, "buffer view", &from)?.byte_stride;
                let bytes = self.container.view(view, &from)?;
                self.slices(bytes, self.accessor.byte_offset, stride, size, count)?.map(&read).collect()
            }
            None => vec![zero; count],
        };
        let Some(sparse) = &self.accessor.sparse else { return Ok(elements) };
        let Some(changed) = usize::try_from(sparse.count).ok().filter(|&changed| changed <= count) else {
            return Err(self.fail(format!("{} of its {count} elements are replaced", sparse.count)));
        };
        let component = Component::new(sparse.indices.component_type)
            .filter(|component| component.is_index())
            .ok_or_else(|| self.fail("its sparse indices are no unsigned integers".into()))?;
        let places = self.container.view(sparse.indices.buffer_view, &from)?;
        let places = self.slices(places, sparse.indices.byte_offset, None, component.size(), changed)?;
        let values = self.container.view(sparse.values.buffer_view, &from)?;
        let values = self.slices(values, sparse.values.byte_offset, None, size, changed)?;
        for (place, value) in places.zip(values) {
            let place = component.index(place) as usize;
            let element = elements
                .get_mut(place)
                .ok_or_else(|| self.fail(format!("its sparse index {place} is not below {count}")))?;
            *element = read(value);
        }
        Ok(elements)
    }

    /// `count` slices of `size` bytes, `stride` apart. All of them are checked to lie inside `bytes`.
    fn slices<'b>(
        &self,
        bytes: &'b [u8],
        offset: u64,
        stride: Option<u64>,
        size: usize,
        count: usize,
    ) -> Result<impl Iterator<Item = &'b [u8]> + use<'b>, GltfError> {
        let stride = stride.unwrap_or(size as u64);
        if stride < size as u64 {
            return Err(self.fail(format!("its stride of {stride} bytes is less than an element")));
        }
        let needed = match count as u64 {
            0 => 0,
            n => (n - 1).saturating_mul(stride).saturating_add(offset).saturating_add(size as u64),
        };
        if needed > bytes.len() as u64 {
            let what = format!("accessor {}", self.index);
            return Err(GltfError::Truncated { what, needed, found: bytes.len() as u64 });
        }
        let bytes = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..)).unwrap_or_default();
        let elements = bytes.chunks(usize::try_from(stride).unwrap_or(usize::MAX));
        Ok(elements.take(count).map(move |element| element.get(..size).unwrap_or_default()))
    }
}
