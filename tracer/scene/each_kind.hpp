// Questions about a shape that have an answer for each kind of shapes.
#pragma once

namespace plumb {

/// For std::visit(EachKind{[](const Sphere&) ..., [](const Box&) ..., [](const Composite&) ...},
/// shape.geometry): a kind without an answer does not compile.
template <class... Answers>
struct EachKind : Answers... {
  using Answers::operator()...;
};
template <class... Answers>
EachKind(Answers...) -> EachKind<Answers...>;

}  // namespace plumb
