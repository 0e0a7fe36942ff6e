// Dense algebra of this module, in double; products go to OpenBLAS.
#pragma once

#ifndef EIGEN_USE_BLAS
#define EIGEN_USE_BLAS
#endif
#include <Eigen/Dense>

#include <span>
#include <vector>

#include "fit/fit.h"
#include "illum/vector.h"

namespace illum {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// OpenBLAS is called from tasks: one thread each, so that cores are not oversubscribed and sums
/// run in one order. Cheap after the first call; thread safe.
void useOneBlasThread();

/// Second moments with rows and columns ordered by channel (index c * lights + l), so that one
/// operator over lights is three equal diagonal blocks.
struct ChannelMoments {
  int lights = 0;
  Matrix gram;        ///< E[s s^T]
  Matrix covariance;  ///< E[(s - mean)(s - mean)^T]
  Vector mean;
};
ChannelMoments channelMoments(const SampleStatistics& statistics);
/// The same for some of the lights.
ChannelMoments selectLights(const ChannelMoments& moments, std::span<const int> lights);

/// lights x lights: the mean of the channels' diagonal blocks. For an operator that treats all
/// channels alike, mean square errors over pixels and channels follow from it.
Matrix meanOverChannels(const Matrix& perChannel, int lights);

/// The `count` largest eigenvalues, falling, and their eigenvectors as columns, each with its entry
/// of largest magnitude positive, so that the result does not depend on the solver's sign.
struct EigenPairs {
  Vector values;
  Matrix vectors;
};
EigenPairs largestEigenPairs(const Matrix& symmetric, int count);

/// X of A X = B, where A is symmetric and positive definite (LDL^T, robust where it is nearly
/// singular). Here, so that Eigen's solver is compiled once.
Matrix solveSymmetric(const Matrix& a, const Matrix& b);

}  // namespace illum
