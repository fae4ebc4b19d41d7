//! Typed numbers in buffer views (glTF 2.0, section 3.6.2). Nothing is read before its place was
//! found to exist, with arithmetic that cannot overflow.

use super::buffers::{Document, View};
use super::limits;
use super::notes::{Flaw, no_such};
use gltf_json::accessor::{Accessor, ComponentType, Type, sparse};
use gltf_json::validation::Checked;

/// What an accessor holds, as written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Format {
    pub(super) component: ComponentType,
    /// Components of an element: 1 for SCALAR, 2 to 4 for VEC2 to VEC4, 16 for MAT4.
    pub(super) width: usize,
    pub(super) normalized: bool,
    pub(super) count: usize,
}

impl Format {
    pub(super) fn element_bytes(&self) -> usize {
        self.component.size() * self.width
    }

    /// Name of the type in the file: `VEC3 of float`.
    pub(super) fn name(&self) -> String {
        let width = match self.width {
            1 => "SCALAR",
            2 => "VEC2",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let component = match self.component {
            ComponentType::I8 => "signed bytes",
            ComponentType::U8 => "unsigned bytes",
            ComponentType::I16 => "signed 16 bit numbers",
            ComponentType::U16 => "unsigned 16 bit numbers",
            ComponentType::U32 => "unsigned 32 bit numbers",
            ComponentType::F32 => "floats",
        };
        let normalized = if self.normalized { "normalized " } else { "" };
        format!("{width} of {normalized}{component}")
    }
}

/// The format of an accessor of numbers or vectors, before any of its data is touched.
pub(super) fn format(document: &Document, index: usize) -> Result<Format, Flaw> {
    let format = any_format(document, index)?;
    if format.width > 4 {
        let flaw = Flaw::new("matrices where vectors belong", "export the file again");
        return Err(flaw.rooted(place(index)));
    }
    Ok(format)
}

fn any_format(document: &Document, index: usize) -> Result<Format, Flaw> {
    let accessor = get(document, index)?;
    let at = |flaw: Flaw| flaw.rooted(place(index));
    let (Checked::Valid(component), Checked::Valid(type_)) =
        (accessor.component_type, accessor.type_)
    else {
        return Err(at(Flaw::new(
            "unknown componentType or type",
            "use the values of glTF 2.0, section 5.1",
        )));
    };
    let width = match type_ {
        Type::Scalar => 1,
        Type::Vec2 => 2,
        Type::Vec3 => 3,
        Type::Vec4 => 4,
        Type::Mat4 => 16,
        // Their columns may be padded; nothing that is read has them.
        Type::Mat2 | Type::Mat3 => {
            return Err(at(Flaw::new("matrices where vectors belong", "export the file again")));
        }
    };
    let unpacked = document.unpacked.accessors.get(&index);
    let count = unpacked.map_or(accessor.count.0, |elements| elements.count as u64);
    if count > limits::ELEMENTS {
        let what = format!("{count} elements, at most {} are read", limits::ELEMENTS);
        return Err(at(Flaw::new(what, "split the scene")));
    }
    let component = component.0;
    Ok(Format { component, width, normalized: accessor.normalized, count: count as usize })
}

/// All elements as matrices of 4 x 4 finite floats, column by column.
pub(super) fn matrices(document: &Document, index: usize) -> Result<Vec<[f64; 16]>, Flaw> {
    let form = any_format(document, index)?;
    if form.width != 16 || form.component != ComponentType::F32 {
        let what = format!("{} where matrices of floats belong", form.name());
        return Err(Flaw::new(what, "export the file again").rooted(place(index)));
    }
    let values = elements(document, index, form, [0.0; 16], |bytes| element(form, bytes))?;
    finite(values, index)
}

/// All elements as vectors of `N` finite numbers. The caller has looked at the format.
pub(super) fn vectors<const N: usize>(
    document: &Document,
    index: usize,
) -> Result<Vec<[f64; N]>, Flaw> {
    finite(unchecked_vectors(document, index)?, index)
}

fn finite<const N: usize>(values: Vec<[f64; N]>, index: usize) -> Result<Vec<[f64; N]>, Flaw> {
    match values.iter().position(|value| !is_finite(value)) {
        Some(bad) => Err(Flaw::new(
            format!("element {bad} is not made of finite numbers"),
            "mend the geometry and export it again",
        )
        .rooted(place(index))),
        None => Ok(values),
    }
}

/// All elements as vectors of `N` numbers, perhaps infinite or not numbers.
pub(super) fn unchecked_vectors<const N: usize>(
    document: &Document,
    index: usize,
) -> Result<Vec<[f64; N]>, Flaw> {
    let form = format(document, index)?;
    if form.width != N {
        let what = format!("{} where elements of {N} numbers belong", form.name());
        return Err(Flaw::new(what, "export the file again").rooted(place(index)));
    }
    elements(document, index, form, [0.0; N], |bytes| element(form, bytes))
}

/// Whether no component is infinite or NaN.
pub(super) fn is_finite<const N: usize>(value: &[f64; N]) -> bool {
    value.iter().all(|c| c.is_finite())
}

/// All elements as indices.
pub(super) fn indices(document: &Document, index: usize) -> Result<Vec<u32>, Flaw> {
    let form = format(document, index)?;
    let unsigned =
        matches!(form.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32);
    if form.width != 1 || !unsigned || form.normalized {
        let what = format!("{} where indices belong", form.name());
        let remedy = "indices are SCALAR of unsigned numbers; export the file again";
        return Err(Flaw::new(what, remedy).rooted(place(index)));
    }
    elements(document, index, form, 0, |bytes| unsigned_number(form.component, bytes))
}

/// The format, and the bytes of all elements as stored, one after the other.
pub(super) fn packed(document: &Document, index: usize) -> Result<(Format, Vec<u8>), Flaw> {
    const LONGEST: usize = 16;
    let form = format(document, index)?;
    let size = form.element_bytes();
    let padded = elements(document, index, form, [0; LONGEST], |bytes| {
        let mut element = [0; LONGEST];
        element[..size].copy_from_slice(bytes);
        element
    })?;
    Ok((form, padded.iter().flat_map(|element| &element[..size]).copied().collect()))
}

fn get<'a>(document: &'a Document, index: usize) -> Result<&'a Accessor, Flaw> {
    let all = &document.root.accessors;
    all.get(index).ok_or_else(|| no_such("accessors", index, all.len()))
}

fn place(index: usize) -> String {
    format!("accessors[{index}]")
}

/// Dense elements, then those that a sparse part replaces.
fn elements<T: Clone>(
    document: &Document,
    index: usize,
    form: Format,
    zero: T,
    read: impl Fn(&[u8]) -> T,
) -> Result<Vec<T>, Flaw> {
    let accessor = get(document, index)?;
    let unpacked = document.unpacked.accessors.get(&index);
    let mut values = match (&accessor.buffer_view, &accessor.sparse) {
        _ if unpacked.is_some() => {
            let bytes = unpacked.map_or(&[][..], |elements| &elements.bytes);
            let strided = Strided::new(View { bytes, stride: None }, 0, form);
            strided.map_err(|f| f.rooted(place(index)))?.elements().map(&read).collect()
        }
        (Some(view), _) => {
            let offset = accessor.byte_offset.map_or(0, |o| o.0);
            let view = document.view(view.value())?;
            let strided = Strided::new(view, offset, form).map_err(|f| f.rooted(place(index)))?;
            strided.elements().map(&read).collect()
        }
        // Zeros, of which the file holds nothing: as many as a file of that size may ask for.
        (None, Some(_)) if (form.count as u64) <= ZEROS => vec![zero; form.count],
        (None, _) => {
            let what = format!("{} elements without a bufferView", form.count);
            return Err(Flaw::new(what, "export the file again, uncompressed").rooted(place(index)));
        }
    };
    if let Some(sparse) = &accessor.sparse {
        replace(document, sparse, form, &mut values, read).map_err(|f| f.rooted(place(index)))?;
    }
    Ok(values)
}

/// Elements that a sparse accessor may leave to be zero.
const ZEROS: u64 = 1 << 20;

fn replace<T>(
    document: &Document,
    sparse: &sparse::Sparse,
    form: Format,
    values: &mut [T],
    read: impl Fn(&[u8]) -> T,
) -> Result<(), Flaw> {
    let damaged = |what: String| Flaw::new(what, "export the file again").at("sparse");
    if sparse.count.0 > form.count as u64 {
        return Err(damaged(format!("{} of {} elements replaced", sparse.count.0, form.count)));
    }
    let Checked::Valid(component) = sparse.indices.component_type else {
        return Err(damaged("unknown componentType of the indices".into()));
    };
    let count = sparse.count.0 as usize;
    let places = Format { component: component.0, width: 1, normalized: false, count };
    let view = document.view(sparse.indices.buffer_view.value())?;
    let places_at = Strided::new(view, sparse.indices.byte_offset.0, places)
        .map_err(|flaw| flaw.at("sparse.indices"))?;
    let view = document.view(sparse.values.buffer_view.value())?;
    let new = Strided::new(view, sparse.values.byte_offset.0, Format { count, ..form })
        .map_err(|flaw| flaw.at("sparse.values"))?;
    for (target, bytes) in places_at.elements().zip(new.elements()) {
        let target = unsigned_number(places.component, target) as usize;
        let length = values.len();
        let slot = values
            .get_mut(target)
            .ok_or_else(|| damaged(format!("element {target} of {length} is replaced")))?;
        *slot = read(bytes);
    }
    Ok(())
}

/// Elements at equal distances, all inside their view.
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
    form: Format,
}

impl<'a> Strided<'a> {
    fn new(view: View<'a>, offset: u64, form: Format) -> Result<Self, Flaw> {
        let element = form.element_bytes();
        let stride = view.stride.unwrap_or(element);
        if stride < element {
            let what = format!("elements of {element} bytes every {stride} bytes");
            return Err(Flaw::new(what, "a byteStride is at least the size of an element"));
        }
        let reach = form
            .count
            .checked_sub(1)
            .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(element));
        let bytes = reach
            .and_then(|reach| super::buffers::part(view.bytes, offset, reach as u64))
            .ok_or_else(|| {
                let what = format!(
                    "{} elements from byte {offset}, {stride} bytes apart, reach past the end of \
                     their view of {} bytes",
                    form.count,
                    view.bytes.len()
                );
                Flaw::new(what, "the file is damaged; export it again")
            })?;
        Ok(Self { bytes, stride, form })
    }

    fn elements(&self) -> impl Iterator<Item = &'a [u8]> {
        let (bytes, stride, element) = (self.bytes, self.stride, self.form.element_bytes());
        (0..self.form.count).map(move |k| &bytes[k * stride..k * stride + element])
    }
}

fn element<const N: usize>(form: Format, bytes: &[u8]) -> [f64; N] {
    let size = form.component.size();
    std::array::from_fn(|k| number(form, &bytes[k * size..(k + 1) * size]))
}

/// One component; normalized integers become -1 to 1 or 0 to 1 (section 3.11).
pub(super) fn number(form: Format, bytes: &[u8]) -> f64 {
    let (value, full) = match *bytes {
        [a] if form.component == ComponentType::I8 => (f64::from(a as i8), 127.0),
        [a] => (f64::from(a), 255.0),
        [a, b] if form.component == ComponentType::I16 => {
            (f64::from(i16::from_le_bytes([a, b])), 32767.0)
        }
        [a, b] => (f64::from(u16::from_le_bytes([a, b])), 65535.0),
        [a, b, c, d] if form.component == ComponentType::F32 => {
            return f64::from(f32::from_le_bytes([a, b, c, d]));
        }
        [a, b, c, d] => (f64::from(u32::from_le_bytes([a, b, c, d])), f64::from(u32::MAX)),
        _ => return f64::NAN,
    };
    if form.normalized { (value / full).max(-1.0) } else { value }
}

fn unsigned_number(component: ComponentType, bytes: &[u8]) -> u32 {
    let mut word = [0; 4];
    word[..component.size()].copy_from_slice(bytes);
    u32::from_le_bytes(word)
}
