#pragma once
// The Cholesky factor of a sparse symmetric positive definite matrix of 6 x 6 blocks, one row of blocks a
// body: rows are found one after the other, the fill of each from the elimination tree (Liu 1990; Davis 2006,
// ch. 4, where entries are single numbers). In blocks most of the time goes into products
// instead of indices. Tested in tests/engine/response/block_cholesky_test.cpp.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace carom {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Below the diagonal: row > column, in blocks.
struct OffDiagonalBlock {
  int row = 0;
  int column = 0;
  Mat6 value = Mat6::Zero();
};

class BlockCholesky {
 public:
  /// Where blocks are; values may change from one `factorize` to the next. `blocks`: no place twice.
  BlockCholesky(int rows, std::span<const OffDiagonalBlock> blocks);

  /// `blocks` in the places that the constructor was given. False, and no factor, when the matrix is not
  /// positive definite.
  bool factorize(std::span<const Mat6> diagonal, std::span<const OffDiagonalBlock> blocks);

  /// What a factorisation takes: products of blocks.
  long products() const { return products_; }

  /// Solves for the right side `x`, in place.
  void solve(Eigen::VectorXd& x) const;

 private:
  struct Entry {
    int row = 0;
    Mat6 value;
  };

  void findTree(std::span<const OffDiagonalBlock> blocks);
  void findFill(int row, std::span<const OffDiagonalBlock> blocks);

  int rows_ = 0;
  long products_ = 0;
  std::vector<int> row_begin_;               ///< Of each row in `by_row_`, and the end.
  std::vector<int> by_row_;                  ///< Indices of blocks.
  std::vector<int> parent_;                  ///< In the elimination tree; -1: none.
  std::vector<int> seen_in_;                 ///< The row whose fill a column was last found in.
  std::vector<int> fill_;                    ///< Columns of the row at hand, in an order that eliminates.
  std::vector<Mat6> at_hand_;                ///< The row at hand, one block a column.
  std::vector<Mat6> pivots_;                 ///< Lower triangles on the diagonal of the factor.
  std::vector<std::vector<Entry>> columns_;  ///< Of the factor, below the diagonal, by row.
};

}  // namespace carom
