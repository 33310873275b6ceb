// Sums over the threads of a workgroup of kGroupThreads, which the shader defines before.
#ifndef VASA_GROUP_SUM
#define VASA_GROUP_SUM

// Where a group sums triangles and blocks of their vertices, one word holds both: triangles below, blocks above.
const uint kTriangleBits = 17, kTriangleMask = (1u << kTriangleBits) - 1u;

const uint kSumBlock = 16;
shared uint groupValues[kGroupThreads], groupSums[kGroupThreads / kSumBlock];

// Of the values of all threads before this one. Called by every thread.
uint sumBefore(uint local, uint value) {
  barrier();  // what an earlier call left has been read
  groupValues[local] = value;
  barrier();
  if (local < kGroupThreads / kSumBlock) {
    uint sum = 0;
    for (uint k = 0; k < kSumBlock; ++k) sum += groupValues[local * kSumBlock + k];
    groupSums[local] = sum;
  }
  barrier();
  uint sum = 0, block = local / kSumBlock;
  for (uint k = 0; k < block; ++k) sum += groupSums[k];
  for (uint k = block * kSumBlock; k < local; ++k) sum += groupValues[k];
  return sum;
}

#endif
