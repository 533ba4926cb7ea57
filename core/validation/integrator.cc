#include "core/validation/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr int kStages = 12;

constexpr double kC[kStages] = {0.0,
                                0.0526001519587677318785587544488,
                                0.0789002279381515978178381316732,
                                0.118350341907227396726757197510,
                                0.281649658092772603273242802490,
                                0.333333333333333333333333333333,
                                0.25,
                                0.307692307692307692307692307692,
                                0.651282051282051282051282051282,
                                0.6,
                                0.857142857142857142857142857142,
                                1.0};

constexpr double kA[kStages][kStages] = {
    {},
    {5.26001519587677318785587544488e-2},
    {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
    {2.95875854768068491816892993775e-2, 0, 8.87627564304205475450678981324e-2},
    {2.41365134159266685502369798665e-1, 0, -8.84549479328286085344864962717e-1, 9.24834003261792003115737966543e-1},
    {3.7037037037037037037037037037e-2, 0, 0, 1.70828608729473871279604482173e-1, 1.25467687566822425016691814123e-1},
    {3.7109375e-2, 0, 0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2, -1.7578125e-2},
    {3.70920001185047927108779319836e-2, 0, 0, 1.70383925712239993810214054705e-1, 1.07262030446373284651809199168e-1,
     -1.53194377486244017527936158236e-2, 8.27378916381402288758473766002e-3},
    {6.24110958716075717114429577812e-1, 0, 0, -3.36089262944694129406857109825, -8.68219346841726006818189891453e-1,
     2.75920996994467083049415600797e1, 2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
    {4.77662536438264365890433908527e-1, 0, 0, -2.48811461997166764192642586468, -5.90290826836842996371446475743e-1,
     2.12300514481811942347288949897e1, 1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
     -2.03312017085086261358222928593e-2},
    {-9.3714243008598732571704021658e-1, 0, 0, 5.18637242884406370830023853209, 1.09143734899672957818500254654,
     -8.14978701074692612513997267357, -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1,
     2.49360555267965238987089396762, -3.0467644718982195003823669022},
    {2.27331014751653820792359768449, 0, 0, -1.05344954667372501984066689879e1, -2.00087205822486249909675718444,
     -1.79589318631187989172765950534e1, 2.79488845294199600508499808837e1, -2.85899827713502369474065508674,
     -8.87285693353062954433549289258, 1.23605671757943030647266201528e1, 6.43392746015763530355970484046e-1}};

// Weights of order 8.
constexpr double kB[kStages] = {5.42937341165687622380535766363e-2, 0, 0, 0, 0, 4.45031289275240888144113950566,
                                1.89151789931450038304281599044, -5.8012039600105847814672114227,
                                3.1116436695781989440891606237e-1, -1.52160949662516078556178806805e-1,
                                2.01365400804030348374776537501e-1, 4.47106157277725905176885569043e-2};

// Differences to the embedded formulas of order 5 and 3.
constexpr double kE5[kStages] = {0.1312004499419488073250102996e-1, 0, 0, 0, 0, -0.1225156446376204440720569753e+1,
                                 -0.4957589496572501915214079952, 0.1664377182454986536961530415e+1,
                                 -0.3503288487499736816886487290, 0.3341791187130174790297318841,
                                 0.8192320648511571246570742613e-1, -0.2235530786388629525884427845e-1};
constexpr double kE3[kStages] = {kB[0] - 0.244094488188976377952755905512, 0, 0, 0, 0, kB[5], kB[6], kB[7],
                                 kB[8] - 0.733846688281611857341361741547, kB[9], kB[10],
                                 kB[11] - 0.220588235294117647058823529412e-1};

}  // namespace

double Dop853::StepFromFirstStage(const RightSide& right_side, double t, const VectorX& x, double h, double tolerance,
                                  VectorX* next) {
  const Eigen::Index n = x.size();
  for (int i = 1; i < kStages; ++i) {
    argument_ = x;
    for (int j = 0; j < i; ++j) {
      if (kA[i][j] != 0) argument_ += (h * kA[i][j]) * stages_[j];
    }
    stages_[i].resize(n);
    right_side(t + kC[i] * h, argument_, &stages_[i]);
  }
  *next = x;
  for (int i = 0; i < kStages; ++i) {
    if (kB[i] != 0) *next += (h * kB[i]) * stages_[i];
  }
  double error5 = 0, error3 = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    double e5 = 0, e3 = 0;
    for (int i = 0; i < kStages; ++i) {
      e5 += kE5[i] * stages_[i][k];
      e3 += kE3[i] * stages_[i][k];
    }
    const double scale = tolerance * (1 + std::max(std::abs(x[k]), std::abs((*next)[k])));
    error5 += (e5 / scale) * (e5 / scale);
    error3 += (e3 / scale) * (e3 / scale);
  }
  const double denominator = error5 + 0.01 * error3;
  if (denominator == 0) return 0;
  return std::abs(h) * error5 / std::sqrt(denominator * static_cast<double>(n));
}

double Dop853::Step(const RightSide& right_side, double t, const VectorX& x, double h, double tolerance,
                    VectorX* next) {
  stages_[0].resize(x.size());
  right_side(t, x, &stages_[0]);
  return StepFromFirstStage(right_side, t, x, h, tolerance, next);
}

IntegrationStatus Dop853::Integrate(const RightSide& right_side, double t, double end, const Options& options,
                                    VectorX* x, const Observer& observer) {
  ROLLGAIT_CHECK(options.tolerance > 0 && end >= t);
  accepted_ = 0;
  stages_[0].resize(x->size());
  right_side(t, *x, &stages_[0]);
  if (observer) observer(t, *x);
  double h = options.first_step > 0 ? std::min(options.first_step, end - t) : end - t;
  proposed_step_ = h;
  bool rejected = false;
  for (int step = 0; t < end; ++step) {
    if (step == options.max_steps) return IntegrationStatus::kTooManySteps;
    const bool last = t + 1.000001 * h >= end;  // no remainder too short to be worth a step
    if (last) h = end - t;
    const double error = StepFromFirstStage(right_side, t, *x, h, options.tolerance, &next_);
    const bool finite = std::isfinite(error) && next_.allFinite();
    // The estimate behaves as h⁸. Factors after Hairer, Nørsett, Wanner.
    const double factor = finite ? std::clamp(0.9 * std::pow(std::max(error, 1e-16), -1.0 / 8), 0.333, 6.0) : 0.1;
    if (finite && error <= 1) {
      ++accepted_;
      t = last ? end : t + h;
      *x = next_;
      right_side(t, *x, &stages_[0]);
      if (observer) observer(t, *x);
      // A step that was cut short by the end says little about the next one; keep the longer.
      proposed_step_ = std::max(last ? proposed_step_ : 0.0, h * (rejected ? std::min(factor, 1.0) : factor));
      h = h * (rejected ? std::min(factor, 1.0) : factor);
      rejected = false;
    } else {
      rejected = true;
      h *= factor;
      proposed_step_ = h;
      if (h <= 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(end))) {
        return finite ? IntegrationStatus::kStepTooSmall : IntegrationStatus::kNotFinite;
      }
    }
  }
  return IntegrationStatus::kReachedEnd;
}

}  // namespace rollgait
