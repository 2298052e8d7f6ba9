#include "references/studies/stability/boxes.hpp"
#include "references/studies/stability/conditions.hpp"
#include "references/studies/stability/embree.hpp"
#include "tracer/methods/box.hpp"

namespace plumb::studies::stability {
namespace {

template <class Setting>
std::vector<Method> boxes(Setting) {
  constexpr const char* edge = "points on an edge are rounded to outside";
  constexpr const char* slabs = "compare distances along the ray, not points";
  return {
      method(
          {"lecture", "the lecture", lecture.cause, lecture.remedy},
          []<class R>(Is<R>) { return box_trial<R>(&formulas::intersect_box<R>, &Setting::template of<R>); }),
      method(
          {"box-six-planes", "the lecture's slide", edge, slabs},
          []<class R>(Is<R>) { return box_trial<R>(&methods::box_six_planes<R>, &Setting::template of<R>); }),
      method({"box-front-faces", "Woo 1990", edge, slabs},
             []<class R>(Is<R>) {
               return box_trial<R>(&methods::box_front_faces<R>, &Setting::template of<R>);
             }),
      method(
          {"box-kay-kajiya", "Kay, Kajiya 1986", lecture.cause, "widen the far side by 2 ulp"},
          []<class R>(Is<R>) { return box_trial<R>(&methods::box_kay_kajiya<R>, &Setting::template of<R>); }),
      method(
          {"box-williams", "Williams et al. 2005", "0 times infinity in the plane of a face",
           "a case for direction 0"},
          []<class R>(Is<R>) { return box_trial<R>(&methods::box_williams<R>, &Setting::template of<R>); }),
      method({"box-ize", "Ize 2013", lecture.cause, lecture.remedy},
             []<class R>(Is<R>) { return box_trial<R>(&methods::box_ize<R>, &Setting::template of<R>); }),
      by_embree("embree", "Embree 3, six quadrilaterals",
                box_trial<float>(&embree_box, &Setting::template of<float>))};
}
struct Thin {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return thin_box<R>(v, random);
  }
};
struct Edge {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return box_edge<R>(v, random);
  }
};
struct Parallel {
  template <class R>
  static BoxCase<R> of(double v, Random& random) {
    return near_parallel<R>(v, random);
  }
};

}  // namespace

std::vector<ConditionEntry> conditions_of_boxes() {
  return {{"box-aspect", "width / thickness", 1e12, false, 3000, boxes(Thin())},
          {"box-edge", "1 / distance of the aim from an edge", 1e18, false, 3000, boxes(Edge())},
          {"box-parallel", "1 / tilt", 1e18, false, 3000, boxes(Parallel())}};
}

}  // namespace plumb::studies::stability
