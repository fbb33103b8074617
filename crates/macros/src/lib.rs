//! Attribute macros of Simbeeotic.
//!
//! [`params`] makes a struct readable from a scenario: units, defaults, schema, unknown keys are
//! errors. [`choice`] does the same for an enum. One attribute for each kind of part puts a type on the shelf under a name:
//! [`behavior`], [`vehicle`], [`sensor`], [`radio`], [`antenna`], [`propagation`], [`fading`], [`medium`],
//! [`weather`], [`generator`], [`component`]. The type's doc comment becomes the text of `simbeeotic describe`.
//!
//! ```ignore
//! /// A bee that circles its start.
//! #[behavior("circle-bee")]
//! pub struct CircleBee { params: CircleBeeParams }
//!
//! /// Parameters of [`CircleBee`].
//! #[params]
//! pub struct CircleBeeParams {
//!     /// How fast it flies.
//!     pub speed: Speed,
//! }
//! ```
//! Options after the name: `host = Station` (what carries a behaviour; a flying vehicle unless
//! said), `java = "full.class.Name"` (names the original knew the part by; repeatable).

use proc_macro::TokenStream;
use proc_macro2::{Span, TokenStream as Tokens};
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::{DeriveInput, Expr, ExprLit, Ident, Lit, LitStr, Meta, Path, Token, parse_macro_input};

/// Makes a struct the parameters of a part: read from scenarios with units, defaults and a schema.
///
/// The struct must implement [`Default`]; those are the values of keys that a scenario leaves out.
/// Unknown keys are errors. Field docs become the parameter's documentation.
#[proc_macro_attribute]
pub fn params(arguments: TokenStream, item: TokenStream) -> TokenStream {
    if !arguments.is_empty() {
        return error(Span::call_site(), "#[params] takes no arguments").into();
    }
    let item = Tokens::from(item);
    let home = home();
    let (serde, schemars) = (format!("{home}::serde"), format!("{home}::schemars"));
    let home: Path = path(&home);
    quote! {
        #[derive(Clone, Debug, PartialEq, #home::serde::Serialize, #home::serde::Deserialize, #home::schemars::JsonSchema)]
        #[serde(crate = #serde, default, deny_unknown_fields)]
        #[schemars(crate = #schemars)]
        #item
    }
    .into()
}

/// Makes an enum without fields a choice that a scenario writes as kebab-case text.
#[proc_macro_attribute]
pub fn choice(arguments: TokenStream, item: TokenStream) -> TokenStream {
    if !arguments.is_empty() {
        return error(Span::call_site(), "#[choice] takes no arguments").into();
    }
    let item = Tokens::from(item);
    let home = home();
    let (serde, schemars) = (format!("{home}::serde"), format!("{home}::schemars"));
    let home: Path = path(&home);
    quote! {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, #home::serde::Serialize, #home::serde::Deserialize, #home::schemars::JsonSchema)]
        #[serde(crate = #serde, rename_all = "kebab-case")]
        #[schemars(crate = #schemars)]
        #item
    }
    .into()
}

macro_rules! part_attribute {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[proc_macro_attribute]
        pub fn $name(arguments: TokenStream, item: TokenStream) -> TokenStream {
            let arguments = parse_macro_input!(arguments as Arguments);
            let original = Tokens::from(item.clone());
            let input = parse_macro_input!(item as DeriveInput);
            register(stringify!($name), &arguments, &input, &original).into()
        }
    };
}

part_attribute!(
    /// Registers a `Behavior` under a name: `#[behavior("my-bee")]`, `#[behavior("hive", host = Station)]`.
    behavior
);
part_attribute!(
    /// Registers a `Vehicle` under a name: `#[vehicle("simple-bee")]`.
    vehicle
);
part_attribute!(
    /// Registers a `Sensor` under a name: `#[sensor("compass")]`.
    sensor
);
part_attribute!(
    /// Registers a `Radio` under a name: `#[radio("cc2420")]`.
    radio
);
part_attribute!(
    /// Registers an antenna pattern under a name: `#[antenna("isotropic")]`.
    antenna
);
part_attribute!(
    /// Registers a propagation model under a name: `#[propagation("free-space")]`.
    propagation
);
part_attribute!(
    /// Registers a fading model under a name: `#[fading("rician")]`.
    fading
);
part_attribute!(
    /// Registers a level of fidelity of the air under a name: `#[medium("simple")]`.
    medium
);
part_attribute!(
    /// Registers a weather model under a name: `#[weather("constant-weather")]`.
    weather
);
part_attribute!(
    /// Registers a rule that makes worlds under a name: `#[generator("maze")]`.
    generator
);
part_attribute!(
    /// Registers a component under a name: `#[component("recorder")]`.
    component
);

/// `"name"`, then `host = Path` and `java = "..."` in any order.
struct Arguments {
    name: LitStr,
    host: Option<Path>,
    java: Vec<LitStr>,
}

impl Parse for Arguments {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let name: LitStr = input.parse()?;
        let mut arguments = Self {
            name,
            host: None,
            java: Vec::new(),
        };
        check_name(&arguments.name)?;
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let key: Ident = input.parse()?;
            input.parse::<Token![=]>()?;
            match key.to_string().as_str() {
                "host" => arguments.host = Some(input.parse()?),
                "java" => arguments.java.push(input.parse()?),
                _ => return Err(syn::Error::new(key.span(), "expected `host` or `java`")),
            }
        }
        Ok(arguments)
    }
}

/// Part names are kebab-case, as scenario files show them.
fn check_name(name: &LitStr) -> syn::Result<()> {
    let text = name.value();
    let fits = text.starts_with(|c: char| c.is_ascii_lowercase())
        && text
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
        && !text.ends_with('-');
    if fits {
        Ok(())
    } else {
        Err(syn::Error::new(
            name.span(),
            "a part's name is kebab-case, such as \"my-bee\"",
        ))
    }
}

fn register(kind: &str, arguments: &Arguments, input: &DeriveInput, original: &Tokens) -> Tokens {
    if arguments.host.is_some() && kind != "behavior" {
        return error(arguments.name.span(), "only a behaviour has a host");
    }
    let home = path(&home());
    let (name, java, part) = (&arguments.name, &arguments.java, &input.ident);
    let docs = docs(input);
    let kind = format_ident!("{kind}");
    let host = match (&arguments.host, kind == "behavior") {
        (Some(host), _) => quote!(, #host),
        (None, true) => quote!(, #home::host::Flying),
        (None, false) => quote!(),
    };
    quote! {
        #original

        #home::inventory::submit! {
            #home::registry::Part::#kind::<#part #host>(#home::registry::Label {
                name: #name,
                docs: #docs,
                module: ::core::module_path!(),
                java: &[#(#java),*],
            })
        }
    }
}

/// The doc comment, one leading space a line removed.
fn docs(input: &DeriveInput) -> String {
    let lines = input
        .attrs
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        });
    lines
        .map(|l| l.strip_prefix(' ').unwrap_or(&l).to_owned())
        .collect::<Vec<_>>()
        .join("\n")
}

/// Where the model API lives for the crate being compiled: users see it through the facade.
fn home() -> String {
    const HOUSE: [&str; 5] = [
        "simbeeotic-model",
        "simbeeotic-models",
        "simbeeotic-record",
        "simbeeotic-scenario",
        "simbeeotic-view",
    ];
    match std::env::var("CARGO_PKG_NAME") {
        Ok(name) if HOUSE.contains(&name.as_str()) => "::simbeeotic_model".to_owned(),
        _ => "::simbeeotic::model".to_owned(),
    }
}

fn path(text: &str) -> Path {
    syn::parse_str(text).unwrap_or_else(|_| Path::from(Ident::new("simbeeotic", Span::call_site())))
}

fn error(span: Span, message: &str) -> Tokens {
    syn::Error::new(span, message).to_compile_error()
}
