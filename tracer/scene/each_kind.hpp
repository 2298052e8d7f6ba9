// Asks a question about a shape that each kind of shapes answers.
#pragma once

namespace plumb {

/// For std::visit(EachKind{[](const Sphere&) ..., [](const Box&) ..., [](const Composite&) ...},
/// shape.geometry). A kind without an answer does not compile.
template <class... Answers>
struct EachKind : Answers... {
  using Answers::operator()...;
};
template <class... Answers>
EachKind(Answers...) -> EachKind<Answers...>;

}  // namespace plumb
