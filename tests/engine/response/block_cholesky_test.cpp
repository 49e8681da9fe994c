// The sparse factor against Eigen's dense one.

#include "engine/response/block_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

struct BlockMatrix {
  std::vector<Mat6> diagonal;
  std::vector<OffDiagonalBlock> blocks;

  int rows() const { return static_cast<int>(diagonal.size()); }
  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6 * rows(), 6 * rows());
    for (int i = 0; i < rows(); ++i) m.block<6, 6>(6 * i, 6 * i) = diagonal[static_cast<std::size_t>(i)];
    for (const OffDiagonalBlock& b : blocks) {
      m.block<6, 6>(6 * b.row, 6 * b.column) = b.value;
      m.block<6, 6>(6 * b.column, 6 * b.row) = b.value.transpose();
    }
    return m;
  }
};

Mat6 randomBlock(Random& random) {
  Mat6 m;
  for (Eigen::Index i = 0; i < m.size(); ++i) m(i) = random.uniform(-1, 1);
  return m;
}

// Contacts: each pair of rows that is joined adds J' S J, as in held_rows.h.
void join(Random& random, int row, int column, BlockMatrix& m) {
  const Mat6 j_row = randomBlock(random);
  const Mat6 j_column = randomBlock(random);
  m.diagonal[static_cast<std::size_t>(row)] += j_row.transpose() * j_row;
  m.diagonal[static_cast<std::size_t>(column)] += j_column.transpose() * j_column;
  m.blocks.push_back({row, column, j_row.transpose() * j_column});
}

BlockMatrix randomMatrix(Random& random, int rows, double joined) {
  BlockMatrix m{std::vector<Mat6>(static_cast<std::size_t>(rows), Mat6::Identity()), {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < row; ++column)
      if (random.uniform(0, 1) < joined) join(random, row, column, m);
  return m;
}

double residualOf(const BlockMatrix& m, BlockCholesky& factor, Random& random) {
  Eigen::VectorXd b(6 * m.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i) b(i) = random.uniform(-1, 1);
  Eigen::VectorXd x = b;
  EXPECT_TRUE(factor.factorize(m.diagonal, m.blocks));
  factor.solve(x);
  const Eigen::VectorXd truth = m.dense().llt().solve(b);
  return (x - truth).norm() / truth.norm();
}

// By hand: row i of a full matrix takes 1 + 2 + ... + i; a chain fills nothing.
TEST(BlockCholesky, CountsItsProducts) {
  Random random(908);
  for (int rows : {1, 2, 3, 10, 25}) {
    const BlockMatrix full = randomMatrix(random, rows, 1.0);
    BlockMatrix chain{std::vector<Mat6>(static_cast<std::size_t>(rows), Mat6::Identity()), {}};
    for (int row = 1; row < rows; ++row) join(random, row, row - 1, chain);
    BlockCholesky of_full(rows, full.blocks), of_chain(rows, chain.blocks);
    for (int again = 0; again < 2; ++again) {
      ASSERT_TRUE(of_full.factorize(full.diagonal, full.blocks));
      ASSERT_TRUE(of_chain.factorize(chain.diagonal, chain.blocks));
      EXPECT_EQ(of_full.products(), (rows - 1) * rows * (rows + 1) / 6);
      EXPECT_EQ(of_chain.products(), rows - 1);
    }
  }
}

TEST(BlockCholesky, SolvesWhatTheDenseFactorSolves) {
  Random random(907);
  for (int rows : {1, 2, 3, 10, 40})
    for (double joined : {0.0, 0.05, 0.3, 1.0}) {
      const BlockMatrix m = randomMatrix(random, rows, joined);
      BlockCholesky factor(rows, m.blocks);
      EXPECT_LT(residualOf(m, factor, random), 1e-11) << rows << " rows, " << joined;
    }
}

TEST(BlockCholesky, TakesOtherValuesInTheSamePlaces) {
  Random random(911);
  const BlockMatrix first = randomMatrix(random, 20, 0.15);
  BlockCholesky factor(first.rows(), first.blocks);
  EXPECT_LT(residualOf(first, factor, random), 1e-11);
  BlockMatrix second{std::vector<Mat6>(20, 3.0 * Mat6::Identity()), {}};
  for (const OffDiagonalBlock& b : first.blocks) join(random, b.row, b.column, second);
  EXPECT_LT(residualOf(second, factor, random), 1e-11);
}

// A ring: its last row fills up with what the others leave.
TEST(BlockCholesky, FillsWhereTheMatrixIsEmpty) {
  Random random(919);
  BlockMatrix m{std::vector<Mat6>(30, Mat6::Identity()), {}};
  for (int row = 1; row < 30; ++row) join(random, row, row - 1, m);
  join(random, 29, 0, m);
  BlockCholesky factor(30, m.blocks);
  EXPECT_LT(residualOf(m, factor, random), 1e-11);
}

TEST(BlockCholesky, SaysWhenTheMatrixIsNotPositiveDefinite) {
  Random random(929);
  BlockMatrix m = randomMatrix(random, 10, 0.3);
  BlockCholesky factor(10, m.blocks);
  EXPECT_TRUE(factor.factorize(m.diagonal, m.blocks));
  m.diagonal[7] -= 100.0 * Mat6::Identity();
  EXPECT_FALSE(factor.factorize(m.diagonal, m.blocks));
}

}  // namespace
}  // namespace carom
