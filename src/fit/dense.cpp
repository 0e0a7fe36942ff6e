#include "fit/dense.h"

#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <mutex>

#include "illum/error.h"

// LAPACK's symmetric eigensolver (relatively robust representations; Dhillon and Parlett 2004),
// which OpenBLAS carries without a C header.
extern "C" void dsyevr_(const char* jobz, const char* range, const char* uplo, const int* n,
                        double* a, const int* lda, const double* vl, const double* vu,
                        const int* il, const int* iu, const double* abstol, int* m, double* w,
                        double* z, const int* ldz, int* isuppz, double* work, const int* lwork,
                        int* iwork, const int* liwork, int* info);

namespace illum {

void useOneBlasThread() {
  static std::once_flag once;
  std::call_once(once, [] { openblas_set_num_threads(1); });
}

ChannelMoments channelMoments(const SampleStatistics& statistics) {
  const int lights = statistics.lights, rows = 3 * lights;
  assert(statistics.mean.size() == static_cast<std::size_t>(rows));
  assert(statistics.gram.size() == static_cast<std::size_t>(rows) * rows);
  ChannelMoments moments{lights, Matrix(rows, rows), {}, Vector(rows)};
  const auto source = [lights](int row) { return 3 * (row % lights) + row / lights; };
  for (int i = 0; i < rows; ++i) {
    moments.mean[i] = statistics.mean[source(i)];
    for (int j = 0; j < rows; ++j) {
      const std::size_t at = static_cast<std::size_t>(source(i)) * rows + source(j);
      moments.gram(i, j) = statistics.gram[at];
    }
  }
  moments.covariance = moments.gram - moments.mean * moments.mean.transpose();
  return moments;
}

ChannelMoments selectLights(const ChannelMoments& moments, std::span<const int> lights) {
  std::vector<int> rows;
  for (int c = 0; c < 3; ++c) {
    for (const int l : lights) rows.push_back(c * moments.lights + l);
  }
  return {static_cast<int>(lights.size()), moments.gram(rows, rows), moments.covariance(rows, rows),
          moments.mean(rows)};
}

Matrix meanOverChannels(const Matrix& perChannel, int lights) {
  Matrix sum = Matrix::Zero(lights, lights);
  for (int c = 0; c < 3; ++c) sum += perChannel.block(c * lights, c * lights, lights, lights);
  return sum / 3;
}

EigenPairs largestEigenPairs(const Matrix& symmetric, int count) {
  const int n = static_cast<int>(symmetric.rows());
  assert(symmetric.cols() == n && count >= 0 && count <= n);
  EigenPairs pairs{Vector(count), Matrix(n, count)};
  if (count == 0) return pairs;
  Matrix work = symmetric;
  Vector values(n);
  std::vector<int> support(2 * static_cast<std::size_t>(n)),
      integers(10 * static_cast<std::size_t>(n));
  const int first = n - count + 1, workSize = 64 * n, integerSize = 10 * n;
  std::vector<double> buffer(static_cast<std::size_t>(workSize));
  const double unused = 0, tolerance = 0;
  int found = 0, info = 0;
  dsyevr_("V", "I", "L", &n, work.data(), &n, &unused, &unused, &first, &n, &tolerance, &found,
          values.data(), pairs.vectors.data(), &n, support.data(), buffer.data(), &workSize,
          integers.data(), &integerSize, &info);
  if (info != 0 || found != count) {
    throw Error(Fault::Input,
                "the samples' second moments: expected finite numbers, found none that "
                "their principal components could be computed from");
  }
  pairs.values = values.head(count).reverse();
  pairs.vectors = pairs.vectors.rowwise().reverse().eval();
  for (int k = 0; k < count; ++k) {
    int largest = 0;
    pairs.vectors.col(k).cwiseAbs().maxCoeff(&largest);
    if (pairs.vectors(largest, k) < 0) pairs.vectors.col(k) *= -1;
  }
  return pairs;
}

Matrix solveSymmetric(const Matrix& a, const Matrix& b) {
  return a.ldlt().solve(b);
}

}  // namespace illum
