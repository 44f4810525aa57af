//! `object_dictionary!`: the object dictionary of a device from its specification.
//!
//! ```text
//! mod pmc {
//!     od_macros::object_dictionary!("../pitch.od.yaml", device = "pmc");
//! }
//! ```
//!
//! The items are those that `odgen build --rust` writes into a file and that `od_gen::Builder` makes in a build script;
//! documentation of them is in such a file. The crate that uses the macro depends on `firmware-glue`.
//!
//! The macro compiles the specification every time the crate is compiled. It needs no `syn` and no formatter, so that it
//! builds quickly.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use od_gen::{Expansion, expand};
use proc_macro::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};
use quote::quote;

/// Puts the items of a device's object dictionary where it is written, which should be a module of its own.
///
/// The first argument is the path of the specification, EDS or DCF, relative to the package (the directory of its `Cargo.toml`);
/// `device = "KEY"` chooses a device and can be left out if there is only one.
///
/// Mistakes in the specification become errors of the compiler, with their place in the specification and with help; its
/// warnings become warnings, which the compiler words as the use of a deprecated constant, as a macro has no other way. The crate is compiled again when the specification, or a library file it uses, changes.
#[proc_macro]
pub fn object_dictionary(input: TokenStream) -> TokenStream {
    match Arguments::read(input) {
        Ok(arguments) => arguments.expand(),
        Err(Refusal { message, span }) => compile_error(&message, span),
    }
}

/// What is between the parentheses.
struct Arguments {
    path: String,
    /// The literal with the path: where errors are shown.
    span: Span,
    device: Option<String>,
}

/// Why the arguments cannot be read, and where.
struct Refusal {
    message: String,
    span: Span,
}

impl Refusal {
    fn new(message: &str, span: Span) -> Self {
        Self { message: message.to_owned(), span }
    }
}

impl Arguments {
    fn read(input: TokenStream) -> Result<Self, Refusal> {
        let usage = "expected `object_dictionary!(\"path/of/the.od.yaml\", device = \"key\")`";
        let mut tokens = input.into_iter();
        let (path, span) = match tokens.next() {
            Some(TokenTree::Literal(literal)) => (text(&literal)?, literal.span()),
            Some(unexpected) => return Err(Refusal::new(usage, unexpected.span())),
            None => return Err(Refusal::new(usage, Span::call_site())),
        };
        let mut device = None;
        let rest: Vec<TokenTree> = tokens.collect();
        match rest.as_slice() {
            [] => {}
            [comma] if is_punct(comma, ',') => {}
            [comma, TokenTree::Ident(key), equals, TokenTree::Literal(value), end @ ..]
                if is_punct(comma, ',')
                    && key.to_string() == "device"
                    && is_punct(equals, '=')
                    && end.iter().all(|token| is_punct(token, ','))
                    && end.len() <= 1 =>
            {
                device = Some(text(value)?);
            }
            [first, ..] => return Err(Refusal::new(usage, first.span())),
        }
        Ok(Self { path, span, device })
    }

    fn expand(&self) -> TokenStream {
        let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
        let path = package.join(&self.path);
        // Messages name the file as the user does.
        let shown = env::current_dir()
            .ok()
            .and_then(|working_directory| path.strip_prefix(working_directory).map(Path::to_owned).ok());
        let Expansion { read, errors, warnings, tokens } =
            expand(shown.as_deref().unwrap_or(&path), self.device.as_deref());
        let mut out = TokenStream::new();
        for error in errors {
            // The compiler says `error` itself.
            let error = error.strip_prefix("error").unwrap_or(&error);
            let hint =
                if read.is_empty() { "\nnote: the path starts at the directory of Cargo.toml" } else { "" };
            out.extend(compile_error(&format!("{error}{hint}"), self.span));
        }
        for warning in warnings.into_iter().filter(|warning| is_new(warning)) {
            out.extend(self.warning(&warning));
        }
        // `include_bytes!` makes the compiler watch a file.
        for file in read.iter().map(|file| env::current_dir().unwrap_or_default().join(file)) {
            let file = file.display().to_string();
            out.extend(TokenStream::from(quote!(
                const _: &[u8] = include_bytes!(#file);
            )));
        }
        out.extend(tokens.map(TokenStream::from));
        out
    }

    /// A warning: macros cannot give any, but using something deprecated does.
    fn warning(&self, text: &str) -> TokenStream {
        let note = format!("\n{text}");
        let tokens = quote! {
            const _: () = {
                #[deprecated(note = #note)]
                const SPECIFICATION: () = ();
                SPECIFICATION
            };
        };
        respan(tokens.into(), self.span)
    }
}

/// Whether a warning was not given yet in this crate, for another device of the same specification: the compiler is a process for
/// each crate. Errors are always given, because what the macro expands to is missing without them.
fn is_new(warning: &str) -> bool {
    static GIVEN: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    GIVEN.lock().unwrap_or_else(PoisonError::into_inner).insert(warning.to_owned())
}

fn is_punct(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}

/// The text of a string literal without escapes.
fn text(literal: &Literal) -> Result<String, Refusal> {
    let code = literal.to_string();
    let plain =
        code.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).filter(|text| !text.contains('\\'));
    let raw = code.strip_prefix('r').map(|rest| rest.trim_matches('#'));
    let raw = raw.and_then(|rest| rest.strip_prefix('"')?.strip_suffix('"'));
    plain.or(raw).map(ToOwned::to_owned).ok_or_else(|| {
        Refusal::new("expected a text in quotes; write a path with backslashes as `r\"…\"`", literal.span())
    })
}

/// `compile_error! { "…" }` at a place.
fn compile_error(message: &str, span: Span) -> TokenStream {
    let mut literal = Literal::string(message);
    literal.set_span(span);
    let mut bang = Punct::new('!', Spacing::Alone);
    bang.set_span(span);
    let mut group = Group::new(Delimiter::Brace, TokenTree::Literal(literal).into());
    group.set_span(span);
    TokenStream::from_iter([
        TokenTree::Ident(Ident::new("compile_error", span)),
        TokenTree::Punct(bang),
        TokenTree::Group(group),
    ])
}

/// The same tokens at another place.
fn respan(tokens: TokenStream, span: Span) -> TokenStream {
    let moved = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            let mut moved = Group::new(group.delimiter(), respan(group.stream(), span));
            moved.set_span(span);
            TokenTree::Group(moved)
        }
        mut leaf @ (TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_)) => {
            leaf.set_span(span);
            leaf
        }
    });
    moved.collect()
}
