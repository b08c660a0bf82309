//! Bytes to text and back, in the encoding a file came with: UTF-8, UTF-16, or what its declaration names.

use std::borrow::Cow;
use std::str::Utf8Error;

use super::tree::tag;

/// How a file's text becomes bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Encoding {
    /// Whether a byte order mark comes first.
    pub bom: bool,
    pub form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    Utf8,
    Utf16Le,
    Utf16Be,
    /// Such as windows-1250.
    Legacy(&'static encoding_rs::Encoding),
}

/// A file's text, without the byte order mark.
#[derive(Debug)]
pub(super) struct Decoded {
    pub text: String,
    pub encoding: Encoding,
    /// The declaration names another encoding than the bytes are in.
    pub contradiction: Option<String>,
}

/// Why bytes are not text.
#[derive(Debug)]
pub(super) struct DecodeFault {
    /// The text before the fault, which tells its place.
    pub before: String,
    pub message: String,
    pub hint: String,
}

impl DecodeFault {
    fn at_start(message: String, hint: &str) -> Self {
        Self { before: String::new(), message, hint: hint.into() }
    }
}

const UTF8_BOM: &[u8] = b"\xEF\xBB\xBF";
const UTF16_LE_BOM: &[u8] = b"\xFF\xFE";
const UTF16_BE_BOM: &[u8] = b"\xFE\xFF";

/// Decodes a file. What it accepts, [`encode`] turns back into the same bytes. Owned bytes that are the text are taken for
/// it, and nothing is left of them.
pub(super) fn decode(bytes: &mut Cow<'_, [u8]>) -> Result<Decoded, DecodeFault> {
    if bytes.starts_with(b"\xFF\xFE\0\0") || bytes.starts_with(b"\0\0\xFE\xFF") {
        return Err(DecodeFault::at_start("the file is in UTF-32".into(), "save it as UTF-8"));
    }
    let by_mark = |mark: &[u8], form| bytes.starts_with(mark).then_some((mark.len(), form));
    let marked = by_mark(UTF8_BOM, Form::Utf8)
        .or_else(|| by_mark(UTF16_LE_BOM, Form::Utf16Le))
        .or_else(|| by_mark(UTF16_BE_BOM, Form::Utf16Be));
    let (skip, form) = match marked {
        Some(found) => found,
        None => (0, form_without_mark(bytes)?),
    };
    let encoding = Encoding { bom: skip > 0, form };
    let text = match form {
        Form::Utf8 => decode_utf8(bytes, skip)?,
        Form::Utf16Le => decode_utf16(&bytes[skip..], u16::from_le_bytes)?,
        Form::Utf16Be => decode_utf16(&bytes[skip..], u16::from_be_bytes)?,
        Form::Legacy(legacy) => decode_legacy(bytes, legacy)?,
    };
    let contradiction = declared(&text).filter(|label| !agrees(label, form)).map(|label| {
        format!("the declaration says {}, but the file is in {}", super::shown(label), form.name())
    });
    Ok(Decoded { text, encoding, contradiction })
}

/// The bytes of a text. A character the encoding lacks becomes a character reference.
pub(super) fn encode(text: &str, encoding: Encoding) -> Vec<u8> {
    let units = |order: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(order);
    let mark = if encoding.bom { encoding.form.mark() } else { b"" };
    let mut bytes = mark.to_vec();
    match encoding.form {
        Form::Utf8 => bytes.extend_from_slice(text.as_bytes()),
        Form::Utf16Le => bytes.extend(units(u16::to_le_bytes)),
        Form::Utf16Be => bytes.extend(units(u16::to_be_bytes)),
        Form::Legacy(legacy) => bytes.extend_from_slice(&legacy.encode(text).0),
    }
    bytes
}

impl Form {
    fn mark(self) -> &'static [u8] {
        match self {
            Self::Utf8 => UTF8_BOM,
            Self::Utf16Le => UTF16_LE_BOM,
            Self::Utf16Be => UTF16_BE_BOM,
            Self::Legacy(_) => b"",
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "UTF-8",
            Self::Utf16Le | Self::Utf16Be => "UTF-16",
            Self::Legacy(legacy) => legacy.name(),
        }
    }
}

/// Without a mark, UTF-16 shows by the zero bytes of its first characters; the rest by the declaration.
fn form_without_mark(bytes: &[u8]) -> Result<Form, DecodeFault> {
    match bytes {
        [b'<' | b' ' | b'\t' | b'\r' | b'\n', 0, ..] => return Ok(Form::Utf16Le),
        [0, b'<' | b' ' | b'\t' | b'\r' | b'\n', ..] => return Ok(Form::Utf16Be),
        _ => {}
    }
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(1024)]);
    let Some(label) = declared(&head) else { return Ok(Form::Utf8) };
    match encoding_rs::Encoding::for_label(label.as_bytes()) {
        // A declaration that can be read as ASCII is not in UTF-16, whatever it says.
        Some(found) if found.output_encoding() == encoding_rs::UTF_8 => Ok(Form::Utf8),
        Some(found) => Ok(Form::Legacy(found)),
        None => Err(DecodeFault::at_start(
            format!("the encoding {} is not known", super::shown(label)),
            "save the file as UTF-8",
        )),
    }
}

/// The encoding that an XML declaration at the very start names.
fn declared(text: &str) -> Option<&str> {
    let declaration = &text[..text.find("?>")? + 2];
    let is_declaration = declaration.starts_with("<?") && tag::name(declaration) == "?xml";
    tag::find(declaration, "encoding").filter(|_| is_declaration).map(|attr| attr.raw)
}

fn agrees(label: &str, form: Form) -> bool {
    let Some(declared) = encoding_rs::Encoding::for_label(label.as_bytes()) else { return false };
    match form {
        Form::Utf8 => declared == encoding_rs::UTF_8,
        Form::Utf16Le | Form::Utf16Be => {
            declared == encoding_rs::UTF_16LE || declared == encoding_rs::UTF_16BE
        }
        Form::Legacy(legacy) => declared == legacy,
    }
}

fn decode_utf8(bytes: &mut Cow<'_, [u8]>, skip: usize) -> Result<String, DecodeFault> {
    if skip == 0
        && let Cow::Owned(owned) = bytes
    {
        return String::from_utf8(std::mem::take(owned)).map_err(|err| {
            let fault = not_utf8(err.as_bytes(), err.utf8_error());
            *owned = err.into_bytes();
            fault
        });
    }
    let bytes = &bytes[skip..];
    str::from_utf8(bytes).map(str::to_owned).map_err(|err| not_utf8(bytes, err))
}

fn not_utf8(bytes: &[u8], err: Utf8Error) -> DecodeFault {
    let valid = err.valid_up_to();
    let bad = bytes.get(valid).copied().unwrap_or(0);
    DecodeFault {
        before: String::from_utf8_lossy(&bytes[..valid]).into_owned(),
        message: format!("the byte 0x{bad:02X} is not valid UTF-8"),
        hint: "save the file as UTF-8, or name its encoding in the first line: \
                   <?xml version=\"1.0\" encoding=\"windows-1250\"?>"
            .into(),
    }
}

fn decode_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, DecodeFault> {
    let (pairs, odd) = bytes.as_chunks::<2>();
    let mut text = String::with_capacity(bytes.len() / 2);
    for decoded in char::decode_utf16(pairs.iter().map(|&pair| unit(pair))) {
        match decoded {
            Ok(c) => text.push(c),
            Err(err) => {
                let message = format!("0x{:04X} is half a character of UTF-16", err.unpaired_surrogate());
                return Err(DecodeFault { before: text, message, hint: "save the file as UTF-8".into() });
            }
        }
    }
    if odd.is_empty() {
        return Ok(text);
    }
    let message = "the file ends in the middle of a UTF-16 character".into();
    Err(DecodeFault { before: text, message, hint: "it may have been cut off".into() })
}

fn decode_legacy(bytes: &[u8], legacy: &'static encoding_rs::Encoding) -> Result<String, DecodeFault> {
    let decoded = legacy.decode_without_bom_handling_and_without_replacement(bytes);
    let text = decoded.map(Cow::into_owned).filter(|text| legacy.encode(text).0 == bytes);
    text.ok_or_else(|| {
        let message = format!("the file is not valid {}", legacy.name());
        DecodeFault::at_start(message, "save the file as UTF-8")
    })
}
