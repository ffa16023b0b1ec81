// Two loops over threads. The first is sound; the second, which runs if there is an argument, is a race:
// scripts/sanitize shows by it that ThreadSanitizer sees through this OpenMP, neither silent nor crying wolf.

#include <cstdio>
#include <vector>

int main(int count, char** /*arguments*/) {
  const std::vector<int> ones(100000, 1);
  const int size = static_cast<int>(ones.size());
  int sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum)
  for (int i = 0; i < size; ++i) sum += ones[static_cast<unsigned>(i)];
  int race = 0;
  if (count > 1) {
#pragma omp parallel for schedule(static)
    for (int i = 0; i < size; ++i) race += ones[static_cast<unsigned>(i)];
  }
  std::printf("%d %d\n", sum, race);
}
