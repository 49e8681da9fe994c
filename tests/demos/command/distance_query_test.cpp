// `carom distance`: known answers, batches line by line, and what is refused where with which words.
#include "demos/command/distance_query.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "engine/foundation/contract.h"
#include "tests/demos/support/program_run.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/shell.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// An OBJ file of boxes given by centre, each of edge 1, of twelve triangles.
std::string cubes(const std::vector<Vec3>& centers) {
  const ConvexPolyhedron box = oracle::triangulatedBox(Vec3::Ones());
  std::ostringstream text;
  int first = 1;
  for (const Vec3& c : centers) {
    text << "o cube" << first << '\n';
    for (const Vec3& v : box.vertices()) text << "v " << (v + c).transpose() << '\n';
    for (int f = 0; f < box.faceCount(); ++f) {
      text << 'f';
      for (int v : box.faceVertices(f)) text << ' ' << first + v;
      text << '\n';
    }
    first += 8;
  }
  return text.str();
}

/// A folder with the unit cube in it, and the words of queries about it.
struct Cube {
  TemporaryFolder folder;
  std::string file = folder.file("cube.obj", cubes({Vec3::Zero()})).string();

  std::string line(const std::string& pose_b) const {
    return "{\"a\": \"" + file + "\", \"b\": \"" + file + "\", \"poseB\": " + pose_b + "}\n";
  }
  std::string at(double x) const { return line("{\"position\": [" + std::to_string(x) + ", 0, 0]}"); }
  DistanceQuery query(const Pose& X_WA, const Pose& X_WB) const { return {file, file, X_WA, X_WB}; }
};

Vec3 vectorOf(const Json& json) {
  return {json.items().at(0).asNumber(), json.items().at(1).asNumber(), json.items().at(2).asNumber()};
}

Json ask(const DistanceQuery& query) {
  return DistanceAnswers(DistanceAnswers::Start::kCold).answer(query);
}

std::vector<Json> jsonLines(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line, "out"));
  return lines;
}

struct KnownAnswer {
  const char* what;
  Pose X_WA, X_WB;
  const char* status;
  double distance_m;
  Vec3 normal;
  const char* kind_a;  ///< Empty where several features hold a closest point.
  const char* kind_b;
};

// Each from the geometry of the unit cube; a square turned by 45 degrees reaches sqrt(1/2) far.
std::vector<KnownAnswer> knownAnswers() {
  const double eighth = std::numbers::pi / 4;
  const Vec3 x = Vec3::UnitX();
  const Pose here;
  return {
      {"face to face", here, {Quat::Identity(), {3, 0.2, 0.1}}, "separated", 2.0, x, "", ""},
      {"corner to corner",
       here,
       {Quat::Identity(), {2, 2, 2}},
       "separated",
       std::sqrt(3.0),
       Vec3::Ones().normalized(),
       "vertex",
       "vertex"},
      {"edge across edge",
       {oracle::turned(Vec3::UnitZ(), eighth), Vec3::Zero()},
       {oracle::turned(Vec3::UnitY(), eighth), {3, 0, 0}},
       "separated",
       3 - std::sqrt(2.0),
       x,
       "edge",
       "edge"},
      {"half a turn, coplanar triangles",
       here,
       {Quat(0, 0, 0, 1), {1.5, -0.375, 0.375}},
       "separated",
       0.5,
       x,
       "",
       ""},
      {"a quarter deep", here, {Quat::Identity(), {0.75, 0.1, 0.2}}, "penetrating", -0.25, x, "", ""},
  };
}

TEST(DistanceQuery, GivesTheKnownAnswersOfUnitCubes) {
  const Cube cube;
  for (const KnownAnswer& known : knownAnswers()) {
    SCOPED_TRACE(known.what);
    const Json answer = ask(cube.query(known.X_WA, known.X_WB));
    EXPECT_EQ(answer.at("status").asString(), known.status);
    EXPECT_NEAR(answer.at("distance").asNumber(), known.distance_m, 4e-15);
    EXPECT_LT((vectorOf(answer.at("normal")) - known.normal).norm(), 4e-15);
    const Vec3 way = vectorOf(answer.at("pointB")) - vectorOf(answer.at("pointA"));
    EXPECT_LT((way - known.distance_m * known.normal).norm(), 4e-15);
    if (*known.kind_a == '\0') continue;
    EXPECT_EQ(answer.at("featureA").at("kind").asString(), known.kind_a);
    EXPECT_EQ(answer.at("featureB").at("kind").asString(), known.kind_b);
  }
}

TEST(DistanceQuery, MovingBothMeshesTogetherMovesTheAnswer) {
  const Cube cube;
  oracle::Random random(61);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose X_WA = random.pose(1.0), X_WB = random.pose(3.0), moved = random.pose(10.0);
    const Json here = ask(cube.query(X_WA, X_WB));
    const Json there = ask(cube.query(moved * X_WA, moved * X_WB));
    // Positions of size 10 round by 2e-15; a dozen operations.
    EXPECT_NEAR(here.at("distance").asNumber(), there.at("distance").asNumber(), 3e-14) << "trial " << trial;
  }
}

TEST(DistanceQuery, HullStandsWhereTheFilePutsIt) {
  const Cube cube;
  const fs::path far = cube.folder.file("far.obj", cubes({Vec3(10, 0, 0)}));
  EXPECT_NEAR(ask({cube.file, far.string(), {}, {}}).at("distance").asNumber(), 9.0, 1e-14);
}

TEST(DistanceQuery, MeshesOfOneFileMakeOneHull) {
  const Cube cube;
  const fs::path pair = cube.folder.file("pair.obj", cubes({Vec3(-3, 0, 0), Vec3(3, 0, 0)}));
  const Json between = ask({pair.string(), cube.file, {}, {Quat::Identity(), {0, 0, 0.75}}});
  EXPECT_NEAR(between.at("distance").asNumber(), -0.25, 1e-14) << "the hull spans the gap of the two cubes";
}

TEST(DistanceQuery, TrackedAndColdStartsGiveTheSameDistances) {
  const Cube cube;
  const std::string gem = std::string(CAROM_SOURCE_DIR) + "/assets/meshes/gem.obj";
  DistanceAnswers tracked(DistanceAnswers::Start::kTracked), cold(DistanceAnswers::Start::kCold);
  oracle::Random random(62);
  for (int i = 0; i < 2000; ++i) {
    const DistanceQuery query{cube.file, gem, random.pose(0.5), random.pose(1.5)};
    const Json warm = tracked.answer(query), fresh = cold.answer(query);
    EXPECT_NEAR(warm.at("distance").asNumber(), fresh.at("distance").asNumber(), 1e-14) << "query " << i;
    EXPECT_EQ(warm.at("status").asString(), fresh.at("status").asString()) << "query " << i;
  }
}

// Features of one pair mean nothing on another: the gem has numbers that the cube lacks.
TEST(DistanceQuery, OtherFilesStartAfresh) {
  const Cube cube;
  const std::string gem = std::string(CAROM_SOURCE_DIR) + "/assets/meshes/gem.obj";
  const std::string* const turns[][2] = {
      {&gem, &gem}, {&cube.file, &gem}, {&cube.file, &cube.file}, {&gem, &cube.file}};
  DistanceAnswers answers(DistanceAnswers::Start::kTracked);
  oracle::Random random(63);
  for (std::size_t i = 0; i < 200; ++i) {
    const DistanceQuery query{*turns[i % 4][0], *turns[i % 4][1], random.pose(0.5), random.pose(2.5)};
    EXPECT_EQ(answers.answer(query).text(), ask(query).text()) << "query " << i;
  }
}

TEST(DistanceQuery, ReadsEachFileOnce) {
  const TemporaryFolder folder;
  const std::string file = folder.file("cube.obj", cubes({Vec3::Zero()})).string();
  const std::string late = (folder.path() / "late.obj").string();
  const DistanceQuery apart{file, file, {}, {Quat::Identity(), {3, 0, 0}}};
  DistanceAnswers answers(DistanceAnswers::Start::kTracked);
  const std::string first = answers.answer(apart).text();
  fs::remove(file);
  EXPECT_EQ(answers.answer(apart).text(), first);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(thrownMessage<InputError>([&] {
                answers.answer({file, late, {}, {}});
              }),
              late + ": no such mesh file");
    folder.file("late.obj", cubes({Vec3::Zero()}));
  }
}

TEST(DistanceQuery, PosesAreNormalisedAndIdentityWhereLeftOut) {
  const Pose moved = poseFromText("0.5, -1e-3,2", "--pose-b");
  EXPECT_EQ(moved.position, Vec3(0.5, -1e-3, 2));
  EXPECT_TRUE(moved.rotation.isApprox(Quat::Identity(), 0.0));
  const Pose turned = poseFromText("0,0,0,0.7072,0,0.7072,0", "--pose-b");
  EXPECT_NEAR(turned.rotation.norm(), 1.0, 1e-15);
  const Json line =
      Json::parse("{\"a\": \"a\", \"b\": \"b\", \"poseA\": {\"rotation\": [0.7072, 0, 0.7072, 0]}}", "q");
  const DistanceQuery query = readDistanceQuery(line);
  EXPECT_TRUE(query.X_WA.rotation.isApprox(turned.rotation, 0.0));
  EXPECT_EQ(query.X_WB.position, Vec3::Zero());
}

TEST(DistanceQuery, RefusesPosesThatAreNone) {
  for (const char* text :
       {"", "1", "1,2", "1;2;3", "1,2,3,4", "1,2,x", "1,2,3,", "1,2,3,1,0,0,0,0", "nan,0,0", "inf,0,0",
        "1e13,0,0", "0,0,0,0,0,0,0", "0,0,0,2,0,0,0", "0,0,0,nan,0,0,0"})
    EXPECT_EQ(thrownMessage<UsageError>([&] {
                poseFromText(text, "--pose-a");
              }).rfind(std::string("--pose-a ") + text + ": ", 0),
              0u)
        << text;
}

TEST(DistanceQuery, RefusesLinesThatAreNoneAndSaysWhere) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[]", "q:7:1: [] is an array; accepted: an object"},
      {"{}", "q:7:1: key \"a\" is missing"},
      {"{\"a\": 1, \"b\": \"b\"}", "q:7:7: a: 1 is a number; accepted: a string"},
      {"{\"a\": \"a\", \"b\": \"b\", \"psoeB\": {}}", "did you mean \"poseB\"?"},
      {"{\"a\": \"a\", \"b\": \"b\", \"poseB\": {\"positon\": [0, 0, 0]}}", "did you mean \"position\"?"},
      {"{\"a\": \"a\", \"b\": \"b\", \"poseB\": {\"position\": [0, 0]}}",
       "q:7:44: poseB.position: [0,0] has 2 numbers"},
      {"{\"a\": \"a\", \"b\": \"b\", \"poseB\": {\"position\": [0, 0, 1e13]}}", "is out of range"},
      {"{\"a\": \"a\", \"b\": \"b\", \"poseB\": {\"position\": [0, 0, 1e999]}}", "overflow"},
      {"{\"a\": \"a\", \"b\": \"b\", \"poseA\": {\"rotation\": [0, 0, 0, 0]}}",
       "q:7:44: poseA.rotation: [0,0,0,0] is not of length 1; accepted: a unit quaternion"},
      {"{\"a\": \"a\"", "q:7: syntax error"},
  };
  for (const auto& refused : cases) {
    const std::string& text = refused.first;
    const std::string said = thrownMessage<InputError>([&] { readDistanceQuery(Json::parse(text, "q", 7)); });
    EXPECT_NE(said.find(refused.second), std::string::npos) << text << " gave: " << said;
  }
}

TEST(DistanceCommand, PrintsOneObjectThatReadsBackToTheSameBits) {
  const Cube cube;
  const ProgramEnd end = runCarom({"distance", cube.file, cube.file, "--pose-b", "-1.7,0.3,0.1,0.6,0,0.8,0"});
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(std::count(end.out.begin(), end.out.end(), '\n'), 1);
  const Json expected = ask(cube.query({}, {Quat(0.6, 0, 0.8, 0).normalized(), {-1.7, 0.3, 0.1}}));
  const Json printed = Json::parse(end.out, "out");
  EXPECT_EQ(printed.at("distance").asNumber(), expected.at("distance").asNumber());
  for (const char* key : {"pointA", "pointB", "normal"})
    EXPECT_EQ(vectorOf(printed.at(key)), vectorOf(expected.at(key))) << key;
}

TEST(DistanceCommand, BatchAnswersEachLineInItsPlaceAndEndsWith3ForAnError) {
  const Cube cube;
  const fs::path batch = cube.folder.file(
      "batch.jsonl", cube.at(2) + "\r\n" + cube.line("{\"turn\": 1}") + std::string(70000, ' ') + "\n" +
                         "{\"a\": \"none.obj\", \"b\": \"none.obj\"}\n" + "{\"a\": \r\n" + cube.at(4));
  const ProgramEnd end = runCarom({"distance", "--batch", batch.string()});
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.err, "carom: " + batch.string() +
                         ": 5 of 7 lines could not be answered; each has its \"error\" in the output\n");
  const std::vector<Json> lines = jsonLines(end.out);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_NEAR(lines[0].at("distance").asNumber(), 1.0, 1e-14);
  EXPECT_NEAR(lines[6].at("distance").asNumber(), 3.0, 1e-14);
  const std::string place = batch.string() + ":";
  const char* parts[] = {"2: the line is empty", "3:", "4: the line is too long", "", "6: syntax error"};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::string error = lines[i + 1].at("error").asString();
    const std::string want = *parts[i] == '\0' ? "none.obj: no such mesh file" : place + parts[i];
    EXPECT_EQ(error.rfind(want, 0), 0u) << error;
  }
  EXPECT_NE(lines[2].at("error").asString().find(": poseB.turn: unknown key"), std::string::npos);
}

TEST(DistanceCommand, WarmAndColdBatchesAgreeAndEndWith0) {
  const Cube cube;
  std::string text;
  for (int i = 0; i < 200; ++i) text += cube.at(0.02 * i - 2.01);
  const std::string batch =
      cube.folder.file("batch.jsonl", text + cube.at(9).substr(0, cube.at(9).size() - 1));
  const ProgramEnd warm = runCarom({"distance", "--batch", batch});
  const ProgramEnd cold = runCarom({"distance", "--batch", batch, "--cold"});
  EXPECT_EQ(warm.code, 0) << warm.err;
  EXPECT_EQ(cold.code, 0) << cold.err;
  const std::vector<Json> a = jsonLines(warm.out), b = jsonLines(cold.out);
  ASSERT_EQ(a.size(), 201u) << "the last line counts without a line break, too";
  ASSERT_EQ(b.size(), 201u);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_NEAR(a[i].at("distance").asNumber(), b[i].at("distance").asNumber(), 1e-14);
    EXPECT_NEAR(a[i].at("distance").asNumber(), std::abs(0.02 * static_cast<double>(i) - 2.01) - 1.0, 1e-6);
  }
}

/// The program with both its ends in a pipe: a conversation.
class Conversation {
 public:
  explicit Conversation(const std::vector<std::string>& arguments) {
    int to[2], from[2];
    if (pipe(to) != 0 || pipe(from) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], 0);
      dup2(from[1], 1);
      for (int end : {to[0], to[1], from[0], from[1]}) close(end);
      std::vector<std::string> words{CAROM_BINARY};
      words.insert(words.end(), arguments.begin(), arguments.end());
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    to_ = to[1];
    from_ = from[0];
  }
  void say(const std::string& text) const {
    ASSERT_EQ(write(to_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string hear() const {
    std::string line;
    for (char c = 0; read(from_, &c, 1) == 1 && c != '\n';) line += c;
    return line;
  }
  void stopListening() { close(from_); }
  int end() {
    close(to_);
    int status = 0;
    waitpid(child_, &status, 0);
    return exitCodeOf(status);
  }

 private:
  pid_t child_ = -1;
  int to_ = -1, from_ = -1;
};

TEST(DistanceCommand, AnswersALineOfStandardInputBeforeTheNextIsAsked) {
  const Cube cube;
  Conversation talk({"distance", "--batch", "-"});
  for (int i = 2; i < 6; ++i) {
    talk.say(cube.at(i));
    EXPECT_NEAR(Json::parse(talk.hear(), "out").at("distance").asNumber(), i - 1.0, 1e-14);
  }
  EXPECT_EQ(talk.end(), 0);
}

TEST(DistanceCommand, EndsWhenNobodyListensAnyMore) {
  const Cube cube;
  Conversation talk({"distance", "--batch", "-"});
  talk.say(cube.at(2));
  talk.hear();
  talk.stopListening();
  talk.say(cube.at(3));
  EXPECT_EQ(talk.end(), 128 + SIGPIPE);
}

TEST(DistanceCommand, RefusesInOneLineWithTheExitCodeOfItsKind) {
  const Cube cube;
  struct Case {
    int code;
    std::string part;
    std::vector<std::string> arguments;
  };
  const Case cases[] = {
      {2, "accepted: two mesh files A and B, or --batch FILE", {"distance"}},
      {2, "accepted: two mesh files A and B, or --batch FILE", {"distance", cube.file}},
      {2, "--cold goes with --batch", {"distance", cube.file, cube.file, "--cold"}},
      {2,
       "--batch takes meshes and poses from its lines",
       {"distance", cube.file, cube.file, "--batch", "-"}},
      {2,
       "unknown option --pose-c; did you mean \"--pose-a\"?",
       {"distance", cube.file, cube.file, "--pose-c", "1,0,0"}},
      {2,
       "--pose-b 1,0: accepted: x,y,z or x,y,z,qw,qx,qy,qz",
       {"distance", cube.file, cube.file, "--pose-b", "1,0"}},
      {3, "none.obj: no such mesh file", {"distance", cube.file, "none.obj"}},
      {3,
       "none.jsonl: cannot be read; accepted: a file of JSON lines",
       {"distance", "--batch", "none.jsonl"}},
      {3,
       "cannot be read; accepted: a file of JSON lines",
       {"distance", "--batch", cube.folder.path().string()}},
  };
  for (const Case& c : cases) {
    const ProgramEnd end = runCarom(c.arguments);
    EXPECT_EQ(end.code, c.code) << c.part;
    EXPECT_EQ(end.out, "");
    EXPECT_EQ(end.err.rfind("carom: ", 0), 0u) << end.err;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_NE(end.err.find(c.part), std::string::npos) << end.err;
  }
}

// The reason why there is no hull was empty, as an exception tells it, and so taken for none: a crash.
TEST(DistanceQuery, AMeshWhoseNameEndsAtOnceIsRefusedEachTime) {
  HullStore store;
  for (int turn = 0; turn < 2; ++turn)
    EXPECT_THROW(store.hullOf(std::string("\0", 1)), InputError) << "turn " << turn;
}

TEST(DistanceCommand, HelpShowsAnExampleOfEachForm) {
  const ProgramEnd end = runCarom({"distance", "--help"});
  EXPECT_EQ(end.code, 0);
  for (const char* part : {"Example: carom distance ", "A line of --batch: {", "one convex hull"})
    EXPECT_NE(end.out.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace carom::demos
