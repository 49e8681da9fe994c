#pragma once
// Which islands come to rest (resting.h): those of bodies that press on each other, all of which have lain
// still for a while. Each looks at its own bodies and rows only, found once for all that ask, so that a step
// in which many come to rest costs what their rows cost. Internal to the simulation floor. Tested in
// tests/engine/simulation/resting_islands_test.cpp and through tests/physics/.

#include <vector>

#include "engine/modes/islands.h"
#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/contacts/contact_assembly.h"

namespace carom {

/// Of what the step asks who comes to rest.
struct RestingWorld {
  std::vector<Body>& bodies;
  PairTable& table;
  const FlightPlanner& planner;
  const WorldSettings& settings;  ///< Of the substep.
  const LastingContacts& contacts;
  Crew& crew;
};

/// Kept from step to step for its room only.
class RestingIslands {
 public:
  /// Puts islands of `moving` bodies (ascending) to rest, at the end of a substep. An island that has lain
  /// still long enough and does not rest is asked again when it has done so once more.
  void rest(const RestingWorld& world, std::span<const int> moving, StepCounters& counters);

 private:
  /// An island that has lain still, and what is found of it.
  struct Question {
    std::size_t members_begin = 0, members_end = 0;  ///< In `members_`.
    std::size_t rows_begin = 0, rows_end = 0;        ///< In `rows_`.
    bool rests = false;
    std::vector<RowLoad> balance;  ///< One a row of its own.
  };
  /// Where a body is asked about.
  struct Seat {
    int question = -1;
    int member = -1;  ///< Of that island.
  };
  struct Member {
    int island = -1;
    int body = -1;
    auto operator<=>(const Member&) const = default;
  };

  void findQuestions(const RestingWorld& world, std::span<const int> moving);
  void seatMembers(std::size_t bodies);
  void findRows(const LastingContacts& contacts);
  bool isHeld(const RestingWorld& world, const Question& question) const;
  void ask(const RestingWorld& world, Question& question) const;
  void answer(const RestingWorld& world, const Question& question) const;
  std::span<const Member> membersOf(const Question& question) const {
    return std::span(members_).subspan(question.members_begin, question.members_end - question.members_begin);
  }
  std::span<const std::size_t> rowsOf(const Question& question) const {
    return std::span(rows_).subspan(question.rows_begin, question.rows_end - question.rows_begin);
  }

  Islands pressing_;
  std::vector<Member> members_;
  std::vector<Question> questions_;
  std::vector<std::size_t> rows_;  ///< Of all questions, one after the other, each ascending.
  std::vector<Seat> seats_;        ///< One a body of the world; empty between steps.
};

}  // namespace carom
