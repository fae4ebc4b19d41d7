//! Methods of a type that are written in more than one module: whose `self` calls lead where.
//!
//! A call of a method names no module, so that paths alone do not show that two files of one type know each other.

use syn::visit::{self, Visit};
use syn::{Expr, ExprCall, ExprMethodCall, ImplItem, Item, ItemImpl, Type};

/// One `impl` block of a type.
pub(super) struct Block {
    /// The type, as it is named there.
    pub type_name: String,
    /// Methods and associated functions that it defines.
    pub defines: Vec<String>,
    /// Those of the same type that it calls, each with its line.
    pub calls: Vec<(String, usize)>,
}

/// The inherent `impl` blocks of a file; none where it cannot be parsed, which the compiler tells.
pub(super) fn blocks(source: &str) -> Vec<Block> {
    let items = syn::parse_file(source).map(|file| file.items).unwrap_or_default();
    items
        .iter()
        .filter_map(|item| match item {
            Item::Impl(block) if block.trait_.is_none() => Some(block),
            _ => None,
        })
        .filter_map(read)
        .collect()
}

fn read(block: &ItemImpl) -> Option<Block> {
    let Type::Path(path) = &*block.self_ty else { return None };
    let type_name = path.path.segments.last()?.ident.to_string();
    let defines = block.items.iter().filter_map(|item| match item {
        ImplItem::Fn(method) => Some(method.sig.ident.to_string()),
        _ => None,
    });
    let mut calls = Calls::default();
    calls.visit_item_impl(block);
    Some(Block { type_name, defines: defines.collect(), calls: calls.0 })
}

#[derive(Default)]
struct Calls(Vec<(String, usize)>);

impl<'a> Visit<'a> for Calls {
    fn visit_expr_method_call(&mut self, call: &'a ExprMethodCall) {
        if is_self(&call.receiver) {
            let line = call.method.span().start().line;
            self.0.push((call.method.to_string(), line));
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_call(&mut self, call: &'a ExprCall) {
        if let Expr::Path(function) = &*call.func {
            let segments: Vec<String> =
                function.path.segments.iter().map(|s| s.ident.to_string()).collect();
            if let [first, name] = segments.as_slice()
                && first == "Self"
            {
                let line =
                    function.path.segments.first().map_or(1, |s| s.ident.span().start().line);
                self.0.push((name.clone(), line));
            }
        }
        visit::visit_expr_call(self, call);
    }
}

fn is_self(receiver: &Expr) -> bool {
    matches!(receiver, Expr::Path(path) if path.path.is_ident("self"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_tell_what_they_define_and_call() {
        let source = "struct A;\nimpl<'s> A<'s> {\n fn f(&self) {\n self.g(); Self::h(1); self.x.y(); B::z() }\n fn i() {} }
            impl Clone for A { fn clone(&self) -> Self { self.f() } }";
        let found = blocks(source);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].type_name, "A");
        assert_eq!(found[0].defines, ["f", "i"]);
        let names: Vec<&str> = found[0].calls.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["g", "h"]);
    }

    #[test]
    fn what_cannot_be_parsed_has_no_blocks() {
        assert!(blocks("impl A { fn").is_empty());
    }
}
