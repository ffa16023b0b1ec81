#pragma once

#include <cstdint>

#include "mesogen/export.hpp"

/// Random numbers without a state. Each depends only on a seed, an id and a stream. It therefore depends neither on the
/// order in which particles are visited nor on the number of threads.
namespace mesogen::exec {

/// Four random words from a counter and a key: Philox4x32-10.
/// J. K. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC 2011.
struct Philox {
  std::uint32_t word[4];

  MESOGEN_HOST_DEVICE constexpr Philox(std::uint64_t key, std::uint64_t low, std::uint64_t high)
      : word{static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32), static_cast<std::uint32_t>(high),
             static_cast<std::uint32_t>(high >> 32)} {
    auto key0 = static_cast<std::uint32_t>(key);
    auto key1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t product0 = std::uint64_t{0xD2511F53U} * word[0];
      const std::uint64_t product1 = std::uint64_t{0xCD9E8D57U} * word[2];
      word[0] = static_cast<std::uint32_t>(product1 >> 32) ^ word[1] ^ key0;
      word[1] = static_cast<std::uint32_t>(product1);
      word[2] = static_cast<std::uint32_t>(product0 >> 32) ^ word[3] ^ key1;
      word[3] = static_cast<std::uint32_t>(product0);
      key0 += 0x9E3779B9U;
      key1 += 0xBB67AE85U;
    }
  }
};

/// 64 random bits. `stream` tells apart several numbers of the same particle.
MESOGEN_HOST_DEVICE constexpr std::uint64_t random_bits(std::int64_t seed, std::int64_t id, std::int64_t stream) {
  const Philox random(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(id),
                      static_cast<std::uint64_t>(stream));
  return (std::uint64_t{random.word[1]} << 32) | random.word[0];
}

/// Uniform in [0, 1), a multiple of 2^-53. The arguments are those of random_bits.
MESOGEN_HOST_DEVICE constexpr double random_uniform(std::int64_t seed, std::int64_t id, std::int64_t stream) {
  return static_cast<double>(random_bits(seed, id, stream) >> 11) * 0x1p-53;
}

}  // namespace mesogen::exec
