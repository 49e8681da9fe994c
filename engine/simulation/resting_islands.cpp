#include "engine/simulation/resting_islands.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/modes/resting.h"
#include "engine/simulation/contacts/lasting_contact.h"

namespace carom {

// Bodies that press on each other are one island; those of islands in which all have lain still are asked
// about.
void RestingIslands::findQuestions(const RestingWorld& world, std::span<const int> moving) {
  const std::vector<Body>& bodies = world.bodies;
  pressing_.part(static_cast<int>(bodies.size()));
  for (const ContactRow& row : world.contacts.rows)
    if (row.impulse.x() > 0.0 && bodies[at(row.a)].yields() && bodies[at(row.b)].yields())
      pressing_.join(row.a, row.b);
  // What lies on a kinematic body that moves rides on it, however slowly.
  for (const ContactRow& row : world.contacts.rows)
    for (const auto& [on, by] : {std::pair(row.a, row.b), std::pair(row.b, row.a)})
      if (bodies[at(by)].isDriven()) world.bodies[at(on)].still_s = 0.0;
  members_.clear();
  for (const int body : moving)
    if (bodies[at(body)].moves()) members_.push_back({pressing_.of(body), body});
  std::sort(members_.begin(), members_.end());
  questions_.clear();
  for (std::size_t begin = 0, end = 0; begin < members_.size(); begin = end) {
    double still_s = std::numeric_limits<double>::infinity();
    for (; end < members_.size() && members_[end].island == members_[begin].island; ++end)
      still_s = std::min(still_s, bodies[at(members_[end].body)].still_s);
    if (still_s < tolerance::kRestTime) continue;
    questions_.emplace_back();
    questions_.back().members_begin = begin;
    questions_.back().members_end = end;
  }
}

void RestingIslands::seatMembers(std::size_t bodies) {
  seats_.resize(bodies);
  for (std::size_t k = 0; k < questions_.size(); ++k) {
    int member = 0;
    for (const Member& m : membersOf(questions_[k])) seats_[at(m.body)] = {static_cast<int>(k), member++};
  }
}

// A row between two islands is one of both.
void RestingIslands::findRows(const LastingContacts& contacts) {
  const auto forQuestions = [&](const ContactRow& row, const auto& work) {
    const int a = seats_[at(row.a)].question;
    const int b = seats_[at(row.b)].question;
    if (a >= 0) work(questions_[at(a)]);
    if (b >= 0 && b != a) work(questions_[at(b)]);
  };
  for (const ContactRow& row : contacts.rows) forQuestions(row, [](Question& q) { ++q.rows_end; });
  std::size_t all = 0;
  for (Question& question : questions_) {
    const std::size_t count = question.rows_end;
    question.rows_begin = question.rows_end = all;
    all += count;
  }
  rows_.resize(all);
  for (std::size_t i = 0; i < contacts.rows.size(); ++i)
    forQuestions(contacts.rows[i], [&](Question& q) { rows_[q.rows_end++] = i; });
}

// Whether something holds an island where it is: what it lies on, or rails. Without air and fluids the rest
// flies, however slowly, and keeps its momentum.
bool RestingIslands::isHeld(const RestingWorld& world, const Question& question) const {
  if (!world.planner.isVacuum()) return true;
  const std::vector<Body>& bodies = world.bodies;
  return std::ranges::any_of(membersOf(question),
                             [&](const Member& m) { return bodies[at(m.body)].locks.any(); }) ||
         std::ranges::any_of(rowsOf(question), [&](std::size_t i) {
           const ContactRow& row = world.contacts.rows[i];
           return row.impulse.x() > 0.0 && !(bodies[at(row.a)].moves() && bodies[at(row.b)].moves());
         });
}

// What an island does not consist of, but lies on, is one body that cannot move.
void RestingIslands::ask(const RestingWorld& world, Question& question) const {
  if (!isHeld(world, question)) return;
  const LastingContacts& contacts = world.contacts;
  const FlightPlanner& planner = world.planner;
  std::vector<ImpulseBody> bodies;
  std::vector<double> radii;
  std::vector<Velocity> pushes;
  const std::span<const Member> members = membersOf(question);
  const bool weight_is_all = std::all_of(members.begin(), members.end(), [&](const Member& m) {
    return planner.isWeightAll(m.body, world.bodies[at(m.body)]);
  });
  for (const Member& m : members) {
    const Body& body = world.bodies[at(m.body)];
    if (planner.restless(body)) return;
    bodies.push_back(contacts.bodies[at(m.body)]);
    radii.push_back(body.radius_m);
    if (!weight_is_all) pushes.push_back(planner.pushAtRest(m.body, body));
  }
  const int ground = static_cast<int>(bodies.size());
  bodies.push_back({});
  radii.push_back(0.0);
  if (!weight_is_all) pushes.push_back({});
  const int island = seats_[at(membersOf(question).front().body)].question;
  std::vector<ContactRow> rows;
  std::vector<double> slack_m;
  for (const std::size_t i : rowsOf(question)) {
    ContactRow& row = rows.emplace_back(contacts.rows[i]);
    const auto take = [&](int& body, Vec3& r) {
      const Seat& seat = seats_[at(body)];
      if (seat.question != island) r += contacts.bodies[at(body)].center;
      body = seat.question == island ? seat.member : ground;
    };
    take(row.a, row.r_a);
    take(row.b, row.r_b);
    slack_m.push_back(contacts.sources[i].slack_m);
  }
  question.balance.resize(rows.size());
  question.rests = canRest({rows, bodies, radii, world.settings.gravity, world.settings.step_s, pushes,
                            slack_m, question.balance});
}

// What balances, or nearly so, is what the next step begins with, and what a resting island presses with.
void RestingIslands::answer(const RestingWorld& world, const Question& question) const {
  const std::span<const std::size_t> rows = rowsOf(question);
  for (std::size_t k = 0; k < question.balance.size(); ++k)
    if (!question.balance[k].impulse.isZero(0.0))
      correctLoad(world.contacts, rows[k], question.balance[k], world.settings.step_s, world.table.pairs());
  const std::span<const Member> members = membersOf(question);
  for (std::size_t k = 0; k < members.size(); ++k) {
    Body& body = world.bodies[at(members[k].body)];
    if (!question.rests) {
      body.still_s = 0.0;
      continue;
    }
    body.resting = true;
    body.next_at_rest = members[(k + 1) % members.size()].body;
    body.velocity = {};
  }
}

void RestingIslands::rest(const RestingWorld& world, std::span<const int> moving, StepCounters& counters) {
  findQuestions(world, moving);
  if (questions_.empty()) return;
  seatMembers(world.bodies.size());
  findRows(world.contacts);
  world.crew.runStretches(questions_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) ask(world, questions_[k]);
  });
  for (const Question& question : questions_) {
    answer(world, question);
    for (const Member& member : membersOf(question)) seats_[at(member.body)] = {};
  }
  counters.rest_test_rows += static_cast<int>(rows_.size());
}

}  // namespace carom
