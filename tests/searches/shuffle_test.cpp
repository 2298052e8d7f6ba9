// Varied scenes: the same for a seed, others for another, and they show what the given ones show.
#include "references/submissions/shuffle.hpp"
#include "references/submissions/varied_text.hpp"
#include "references/teaching/matrix.hpp"
#include "tests/support/end_to_end.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::tests {
namespace {

using submissions::JudgedScene;

JudgedScene read_as(const std::string& name, const std::string& text) {
  return {name, text, read_scene(text).scene};
}

JudgedScene judged_scene_of(const std::string& name) {
  return read_as(name, read_file(source_path("tests/scenes/" + name + ".sdf")));
}

/// In a quarter of its pixels: every fault is rendered three times.
JudgedScene small_scene_of(const std::string& name) {
  std::string text = judged_scene_of(name).text;
  const std::string size = " 160 120\n";
  text.replace(text.rfind(size), size.size(), " 80 60\n");
  return read_as(name, text);
}

/// Ids of the faults that a picture of the scene shows.
std::vector<std::string> shown_by(const Scene& scene) {
  const teaching::Lesson lesson{"", scene};
  const auto right = teaching::handed(lesson, {});
  std::vector<std::string> ids;
  for (const faults::Fault& fault : faults::fault_catalogue()) {
    if (teaching::are_told_apart(right, teaching::handed(lesson, {&fault}))) ids.emplace_back(fault.id);
  }
  return ids;
}

class Shuffle : public testing::TestWithParam<Word> {};

TEST_P(Shuffle, ShowsTheSameFaultsInAnotherPicture) {
  const JudgedScene given = small_scene_of(GetParam().text);
  const auto one = submissions::shuffled(given, 1, {});
  const auto again = submissions::shuffled(given, 1, {});
  const auto other = submissions::shuffled(given, 2, {});
  ASSERT_TRUE(one && again && other);
  EXPECT_EQ(one->text, again->text);
  EXPECT_NE(one->text, other->text);
  const auto picture = [](const Scene& scene) { return teaching::handed({"", scene}, {}); };
  EXPECT_TRUE(teaching::are_told_apart(picture(one->scene), picture(given.scene)));
  EXPECT_TRUE(teaching::are_told_apart(picture(one->scene), picture(other->scene)));
  EXPECT_EQ(shown_by(one->scene), shown_by(given.scene));
  EXPECT_EQ(shown_by(other->scene), shown_by(given.scene));
  EXPECT_EQ(read_scene(one->text).scene, one->scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Shuffle,
                         testing::Values(Word{"phong"}, Word{"shadow"}, Word{"sphere"}, Word{"box"},
                                         Word{"composite-dag"}, Word{"refraction"}));

submissions::Variation variation_of(double amount) {
  auto next = std::make_shared<int>(0);
  return {[next] { return ((*next)++ % 199 - 99) / 100.0; }, amount, amount, {2, 0, 1}};
}

TEST(VariedText, NumbersThatSceneIsAboutStay) {
  const std::string text =
      "\xEF\xBB\xBF# what it is\r\n"
      "define material red 1 0 0.2 0.5 0.5 0.5 0 0 0 7 mirror 0.1 0.2 0.3 transmit 0.3 0.2 0.1 eta 1.5\r\n"
      "define shape sphere ball 0 0 -3 1 red\n"
      "define shape box crate -1 0 -4 1 2 -3 red # a crate\n"
      "define shape composite root ball crate\n"
      "transform ball rotate 90 0 0 1\ntransform ball scale 1 2 3\ntransform root translate 0 1 0\n"
      "transform eye translate 0 0 1\n"
      "define light key 4 0 2 1 1 1 0.7\nambient 0.2 0.3 0.4\nbackground 0 0 0\n"
      "define camera eye 60 0 0 0 0 0 -1 0 1 0\nrender eye out.ppm 32 24\n";
  const Scene before = read_scene(text).scene;
  const ReadResult read = read_scene(submissions::varied_text(text, before, variation_of(1)));
  ASSERT_FALSE(read.has_errors()) << read.findings.front().message;
  const Scene& after = read.scene;
  EXPECT_EQ(after.materials[0].m, 7);
  EXPECT_EQ(after.materials[0].eta, before.materials[0].eta);
  EXPECT_EQ(after.materials[0].ks, Rgbd(0));
  EXPECT_NE(after.materials[0].ka, before.materials[0].ka);
  EXPECT_EQ(after.materials[0].ka.x > 0, before.materials[0].ka.z > 0) << "colours changed places";
  EXPECT_EQ(after.shapes[0].transform, before.shapes[0].transform);
  EXPECT_NE(after.shapes[2].transform, before.shapes[2].transform);
  EXPECT_NE(after.cameras[0].transform, before.cameras[0].transform);
  EXPECT_EQ(std::get<Sphere>(after.shapes[0].geometry).center.x, 0);
  EXPECT_NE(std::get<Sphere>(after.shapes[0].geometry).center.z, -3);
  EXPECT_EQ(after.lights[0].position.y, 0);
  EXPECT_EQ(after.lights[0].brightness, 0.7);
  EXPECT_EQ(after.shapes[2].name, "root");
  EXPECT_NE(after.shapes[0].name, "ball");
  EXPECT_EQ(after.renders, (std::vector<RenderRequest>{{after.cameras[0].name, "out.ppm", 32, 24}}));
}

TEST(VariedText, NothingButNamesChangesByNothing) {
  for (const char* const name : {"combined-still-life", "composite-dag", "prototype-401"}) {
    const JudgedScene given = judged_scene_of(name);
    submissions::Variation variation = variation_of(0);
    variation.order = {0, 1, 2};
    Scene after = read_scene(submissions::varied_text(given.text, given.scene, variation)).scene;
    ASSERT_EQ(after.shapes.size(), given.scene.shapes.size());
    for (std::size_t i = 0; i < after.shapes.size(); ++i) after.shapes[i].name = given.scene.shapes[i].name;
    for (std::size_t i = 0; i < after.materials.size(); ++i)
      after.materials[i].name = given.scene.materials[i].name;
    for (std::size_t i = 0; i < after.lights.size(); ++i) after.lights[i].name = given.scene.lights[i].name;
    for (std::size_t i = 0; i < after.cameras.size(); ++i)
      after.cameras[i].name = given.scene.cameras[i].name;
    after.renders = given.scene.renders;
    EXPECT_EQ(after, given.scene) << name;
  }
}

TEST(VariedText, StaysInItsDialect) {
  const std::pair<const char*, const char*> cases[] = {
      {"loose,refl-opacity-ior,post",
       "definematerial red 1 0 0 1 0 0 1 1 1 20 0.1 0.5 1.5 // mine\ndefine shape sphere ball 0 1 -3 1 red\n"
       "define transform ball translate 1 2 3\ntransform ball rotatex 40\ndefine amblight 0.2 0.2 0.2\n"
       "define light diffuse sun 1 2 3 1 1 1\ncamera eye 50\nrender a.ppm eye 32 24\n"},
      {"light-color",
       "define material m 1 0 0 1 0 0 1 1 1 20\ndefine shape box b -1 -1 -5 1 1 -4 m\n"
       "define light sun 1 2 3 1 1 1\ndefine camera eye 50\nrender eye a.ppm 32 24\n"},
      {"la-ld-brightness",
       "define material m 1 0 0 1 0 0 1 1 1 20\ndefine shape box b -1 -1 -5 1 1 -4 m\n"
       "define light sun 1 2 3 0.1 0.1 0.1 1 1 1 0.5\ndefine camera eye 50\nrender eye a.ppm 32 24\n"}};
  for (const auto& [name, text] : cases) {
    const Dialect dialect = parse_dialect(name);
    const ReadResult before = read_scene(text, dialect);
    ASSERT_FALSE(before.has_errors()) << before.findings.front().message;
    const std::string varied = submissions::varied_text(text, before.scene, variation_of(1));
    const ReadResult after = read_scene(varied, dialect);
    ASSERT_FALSE(after.has_errors()) << varied << after.findings.front().message;
    EXPECT_NE(after.scene.shapes[0].geometry, before.scene.shapes[0].geometry) << varied;
    EXPECT_NE(after.scene.lights.at(0).position, before.scene.lights.at(0).position) << varied;
    EXPECT_EQ(after.scene.materials[0].m, 20);
    EXPECT_EQ(after.scene.materials[0].eta, before.scene.materials[0].eta);
    EXPECT_EQ(after.scene.renders[0].file, "a.ppm");
  }
}

}  // namespace
}  // namespace plumb::tests
