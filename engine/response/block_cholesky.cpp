#include "engine/response/block_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "engine/foundation/index.h"

namespace carom {
namespace {

// b := b - a c', entry by entry in one order.
void subtractProduct(const Mat6& a, const Mat6& c, Mat6& b) {
  b.noalias() -= a.lazyProduct(c.transpose());
}

}  // namespace

BlockCholesky::BlockCholesky(int rows, std::span<const OffDiagonalBlock> blocks)
    : rows_(rows),
      row_begin_(at(rows) + 1, 0),
      by_row_(blocks.size()),
      parent_(at(rows), -1),
      seen_in_(at(rows), -1),
      at_hand_(at(rows), Mat6::Zero()),
      pivots_(at(rows)),
      columns_(at(rows)) {
  findTree(blocks);
  std::vector<long> entries(at(rows), 0);
  for (int row = 1; row < rows_; ++row) {  // the first has no fill
    findFill(row, blocks);
    for (const int column : fill_) products_ += ++entries[at(column)];
  }
}

void BlockCholesky::findTree(std::span<const OffDiagonalBlock> blocks) {
  for (const OffDiagonalBlock& block : blocks) ++row_begin_[at(block.row) + 1];
  for (std::size_t row = 0; row < at(rows_); ++row) row_begin_[row + 1] += row_begin_[row];
  std::vector<int> next(row_begin_.begin(), row_begin_.end() - 1);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    by_row_[at(next[at(blocks[i].row)]++)] = static_cast<int>(i);
  // Each row becomes the parent of the subtrees that its columns are in; ancestors are kept short.
  std::vector<int> ancestor(at(rows_), -1);
  for (int row = 0; row < rows_; ++row) {
    for (int k = row_begin_[at(row)]; k < row_begin_[at(row) + 1]; ++k) {
      int column = blocks[at(by_row_[at(k)])].column;
      while (column != -1 && column < row) {
        const int above = std::exchange(ancestor[at(column)], row);
        if (above == -1) parent_[at(column)] = row;
        column = above;
      }
    }
  }
}

// The columns of a row of the factor: all ancestors, below the row, of the columns of the matrix's row.
void BlockCholesky::findFill(int row, std::span<const OffDiagonalBlock> blocks) {
  fill_.clear();
  seen_in_[at(row)] = row;
  for (int k = row_begin_[at(row)]; k < row_begin_[at(row) + 1]; ++k)
    for (int column = blocks[at(by_row_[at(k)])].column; seen_in_[at(column)] != row;
         column = parent_[at(column)]) {
      seen_in_[at(column)] = row;
      fill_.push_back(column);
    }
  std::sort(fill_.begin(), fill_.end());
}

bool BlockCholesky::factorize(std::span<const Mat6> diagonal, std::span<const OffDiagonalBlock> blocks) {
  for (std::vector<Entry>& column : columns_) column.clear();
  std::fill(seen_in_.begin(), seen_in_.end(), -1);
  for (int row = 0; row < rows_; ++row) {
    findFill(row, blocks);
    for (const int column : fill_) at_hand_[at(column)].setZero();
    for (int k = row_begin_[at(row)]; k < row_begin_[at(row) + 1]; ++k) {
      const OffDiagonalBlock& block = blocks[at(by_row_[at(k)])];
      at_hand_[at(block.column)] = block.value;
    }
    Mat6 pivot = diagonal[at(row)];
    for (const int column : fill_) {
      Mat6& value = at_hand_[at(column)];
      pivots_[at(column)].triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(value);
      for (const Entry& below : columns_[at(column)])  // all of them columns of this row, too
        subtractProduct(value, below.value, at_hand_[at(below.row)]);
      subtractProduct(value, value, pivot);
      columns_[at(column)].push_back({row, value});
    }
    const Eigen::LLT<Mat6> llt(pivot);
    if (llt.info() != Eigen::Success) return false;
    pivots_[at(row)] = llt.matrixL();
  }
  return true;
}

void BlockCholesky::solve(Eigen::VectorXd& x) const {
  for (int i = 0; i < rows_; ++i) {
    auto x_i = x.segment<6>(6 * i);
    pivots_[at(i)].triangularView<Eigen::Lower>().solveInPlace(x_i);
    for (const Entry& e : columns_[at(i)]) x.segment<6>(6 * e.row) -= e.value * x_i;
  }
  for (int i = rows_ - 1; i >= 0; --i) {
    auto x_i = x.segment<6>(6 * i);
    for (const Entry& e : columns_[at(i)]) x_i -= e.value.transpose() * x.segment<6>(6 * e.row);
    pivots_[at(i)].triangularView<Eigen::Lower>().transpose().solveInPlace(x_i);
  }
}

}  // namespace carom
