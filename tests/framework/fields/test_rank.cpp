#include "mesogen/fields/rank.hpp"

#include <gtest/gtest.h>

namespace mesogen {
namespace {

TEST(Rank, HasComponentsByDimension) {
  EXPECT_EQ(component_count(Rank::vector, 3), 3);
  EXPECT_EQ(component_count(Rank::matrix, 3), 9);
  EXPECT_EQ(component_count(Rank::order_tensor, 2), 2);
  EXPECT_EQ(component_count(Rank::order_tensor, 3), 5);
}

TEST(Rank, OrderTensorStoresItsUpperTriangleWithoutTheLast) {
  EXPECT_EQ(order_tensor_place(0, 0, 2), 0);
  EXPECT_EQ(order_tensor_place(1, 0, 2), 1);
  EXPECT_EQ(order_tensor_place(1, 1, 2), -1);
  // Q11, Q12, Q13, Q22, Q23
  EXPECT_EQ(order_tensor_place(0, 2, 3), 2);
  EXPECT_EQ(order_tensor_place(1, 1, 3), 3);
  EXPECT_EQ(order_tensor_place(2, 1, 3), 4);
  EXPECT_EQ(order_tensor_place(2, 2, 3), -1);
}

}  // namespace
}  // namespace mesogen
