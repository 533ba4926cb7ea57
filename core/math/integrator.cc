#include "core/math/integrator.h"

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
constexpr double kB[kStages] = {5.42937341165687622380535766363e-2,
                                0,
                                0,
                                0,
                                0,
                                4.45031289275240888144113950566,
                                1.89151789931450038304281599044,
                                -5.8012039600105847814672114227,
                                3.1116436695781989440891606237e-1,
                                -1.52160949662516078556178806805e-1,
                                2.01365400804030348374776537501e-1,
                                4.47106157277725905176885569043e-2};

// Differences to the embedded formulas of order 5 and 3.
constexpr double kE5[kStages] = {0.1312004499419488073250102996e-1,
                                 0,
                                 0,
                                 0,
                                 0,
                                 -0.1225156446376204440720569753e+1,
                                 -0.4957589496572501915214079952,
                                 0.1664377182454986536961530415e+1,
                                 -0.3503288487499736816886487290,
                                 0.3341791187130174790297318841,
                                 0.8192320648511571246570742613e-1,
                                 -0.2235530786388629525884427845e-1};
constexpr double kE3[kStages] = {kB[0] - 0.244094488188976377952755905512,
                                 0,
                                 0,
                                 0,
                                 0,
                                 kB[5],
                                 kB[6],
                                 kB[7],
                                 kB[8] - 0.733846688281611857341361741547,
                                 kB[9],
                                 kB[10],
                                 kB[11] - 0.220588235294117647058823529412e-1};

// Continuous extension: nodes and rows of its three stages (the 13th stage is ẋ at the end of the step), and weights.
constexpr double kExtraC[3] = {0.1, 0.2, 0.777777777777777777777777777778};
constexpr double kExtraA[3][15] = {
    {5.61675022830479523392909219681e-2, 0, 0, 0, 0, 0, 2.53500210216624811088794765333e-1,
     -2.46239037470802489917441475441e-1, -1.24191423263816360469010140626e-1, 1.5329179827876569731206322685e-1,
     8.20105229563468988491666602057e-3, 7.56789766054569976138603589584e-3, -8.298e-3},
    {3.18346481635021405060768473261e-2, 0, 0, 0, 0, 2.83009096723667755288322961402e-2,
     5.35419883074385676223797384372e-2, -5.49237485713909884646569340306e-2, 0, 0, -1.08347328697249322858509316994e-4,
     3.82571090835658412954920192323e-4, -3.40465008687404560802977114492e-4, 1.41312443674632500278074618366e-1},
    {-4.28896301583791923408573538692e-1, 0, 0, 0, 0, -4.69762141536116384314449447206, 7.68342119606259904184240953878,
     4.06898981839711007970213554331, 3.56727187455281109270669543021e-1, 0, 0, 0, -1.39902416515901462129418009734e-3,
     2.9475147891527723389556272149, -9.15095847217987001081870187138}};
constexpr double kD[4][16] = {
    {-0.84289382761090128651353491142e+1, 0, 0, 0, 0, 0.56671495351937776962531783590,
     -0.30689499459498916912797304727e+1, 0.23846676565120698287728149680e+1, 0.21170345824450282767155149946e+1,
     -0.87139158377797299206789907490, 0.22404374302607882758541771650e+1, 0.63157877876946881815570249290,
     -0.88990336451333310820698117400e-1, 0.18148505520854727256656404962e+2, -0.91946323924783554000451984436e+1,
     -0.44360363875948939664310572000e+1},
    {0.10427508642579134603413151009e+2, 0, 0, 0, 0, 0.24228349177525818288430175319e+3,
     0.16520045171727028198505394887e+3, -0.37454675472269020279518312152e+3, -0.22113666853125306036270938578e+2,
     0.77334326684722638389603898808e+1, -0.30674084731089398182061213626e+2, -0.93321305264302278729567221706e+1,
     0.15697238121770843886131091075e+2, -0.31139403219565177677282850411e+2, -0.93529243588444783865713862664e+1,
     0.35816841486394083752465898540e+2},
    {0.19985053242002433820987653617e+2, 0, 0, 0, 0, -0.38703730874935176555105901742e+3,
     -0.18917813819516756882830838328e+3, 0.52780815920542364900561016686e+3, -0.11573902539959630126141871134e+2,
     0.68812326946963000169666922661e+1, -0.10006050966910838403183860980e+1, 0.77771377980534432092869265740,
     -0.27782057523535084065932004339e+1, -0.60196695231264120758267380846e+2, 0.84320405506677161018159903784e+2,
     0.11992291136182789328035130030e+2},
    {-0.25693933462703749003312586129e+2, 0, 0, 0, 0, -0.15418974869023643374053993627e+3,
     -0.23152937917604549567536039109e+3, 0.35763911791061412378285349910e+3, 0.93405324183624310003907691704e+2,
     -0.37458323136451633156875139351e+2, 0.10409964950896230045147246184e+3, 0.29840293426660503123344363579e+2,
     -0.43533456590011143754432175058e+2, 0.96324553959188282948394950600e+2, -0.39177261675615439165231486172e+2,
     -0.14972683625798562581422125276e+3}};

// With equal parts as one rounded product, so that one number gives what it always gave.
double ScaleOf(const Tolerance& tolerance, double size) {
  if (tolerance.relative == tolerance.absolute) return tolerance.relative * (1 + size);
  return tolerance.absolute + tolerance.relative * size;
}

}  // namespace

double Dop853::StepFromFirstStage(const RightSide& right_side, double t, const VectorX& x, double h,
                                  const Tolerance& tolerance, VectorX* next) {
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
  const Eigen::Index controlled = n - quadratures_;
  for (Eigen::Index k = 0; k < controlled; ++k) {
    double e5 = 0, e3 = 0;
    for (int i = 0; i < kStages; ++i) {
      e5 += kE5[i] * stages_[i][k];
      e3 += kE3[i] * stages_[i][k];
    }
    const double scale = ScaleOf(tolerance, std::max(std::abs(x[k]), std::abs((*next)[k])));
    error5 += (e5 / scale) * (e5 / scale);
    error3 += (e3 / scale) * (e3 / scale);
  }
  const double denominator = error5 + 0.01 * error3;
  if (denominator == 0) return 0;
  return std::abs(h) * error5 / std::sqrt(denominator * static_cast<double>(controlled));
}

double Dop853::Step(const RightSide& right_side, double t, const VectorX& x, double h, const Tolerance& tolerance,
                    VectorX* next) {
  stages_[0].resize(x.size());
  right_side(t, x, &stages_[0]);
  return StepFromFirstStage(right_side, t, x, h, tolerance, next);
}

void Dop853::Start(const RightSide& right_side, double t, const VectorX& x, double first_step) {
  ROLLGAIT_CHECK(first_step > 0);
  proposed_step_ = first_step;
  rejected_ = false;
  Restart(right_side, t, x);
}

void Dop853::Restart(const RightSide& right_side, double t, const VectorX& x) {
  derivative_.resize(x.size());
  right_side(t, x, &derivative_);
}

IntegrationStatus Dop853::Advance(const RightSide& right_side, double end, const Tolerance& tolerance, int max_attempts,
                                  double* t, VectorX* x, int* attempts) {
  ROLLGAIT_CHECK(tolerance.relative >= 0 && tolerance.absolute >= 0 && end > *t);
  ROLLGAIT_CHECK(tolerance.relative + tolerance.absolute > 0);
  double h = proposed_step_;
  stages_[0] = derivative_;
  while (true) {
    if (*attempts >= max_attempts) return IntegrationStatus::kTooManySteps;
    ++*attempts;
    const bool last = *t + 1.000001 * h >= end;  // no remainder too short to be worth a step
    if (last) h = end - *t;
    const double error = StepFromFirstStage(right_side, *t, *x, h, tolerance, &next_);
    const bool finite = std::isfinite(error) && next_.allFinite();
    // The estimate behaves as h⁸. Factors after Hairer, Nørsett, Wanner.
    const double factor = finite ? std::clamp(0.9 * std::pow(std::max(error, 1e-16), -1.0 / 8), 0.333, 6.0) : 0.1;
    if (finite && error <= 1) {
      step_start_ = *t;
      step_ = h;
      step_from_ = *x;
      step_to_ = next_;
      *t = last ? end : *t + h;
      *x = next_;
      right_side(*t, *x, &derivative_);
      // A step that was cut short by the end says little about the next one; keep the longer.
      const double next_length = h * (rejected_ ? std::min(factor, 1.0) : factor);
      proposed_step_ = std::max(last ? proposed_step_ : 0.0, next_length);
      rejected_ = false;
      return IntegrationStatus::kReachedEnd;
    }
    rejected_ = true;
    h *= factor;
    proposed_step_ = h;
    if (h <= 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(*t), std::abs(end))) {
      return finite ? IntegrationStatus::kStepTooSmall : IntegrationStatus::kNotFinite;
    }
  }
}

IntegrationStatus Dop853::Integrate(const RightSide& right_side, double t, double end, const Options& options,
                                    VectorX* x, const Observer& observer) {
  ROLLGAIT_CHECK(options.tolerance > 0 && end >= t);
  accepted_ = 0;
  if (end == t) {
    Restart(right_side, t, *x);
    if (observer) observer(t, *x);
    return IntegrationStatus::kReachedEnd;
  }
  Start(right_side, t, *x, options.first_step > 0 ? std::min(options.first_step, end - t) : end - t);
  if (observer) observer(t, *x);
  int attempts = 0;
  while (t < end) {
    const IntegrationStatus status = Advance(right_side, end, options.tolerance, options.max_steps, &t, x, &attempts);
    if (status != IntegrationStatus::kReachedEnd) return status;
    ++accepted_;
    if (observer) observer(t, *x);
  }
  return IntegrationStatus::kReachedEnd;
}

double Dop853::Error(const VectorX& a, const VectorX& b, const Tolerance& tolerance) const {
  double error = 0;
  for (int k = 0; k < a.size() - quadratures_; ++k) {
    const double of_one = std::abs(a[k] - b[k]) / ScaleOf(tolerance, std::max(std::abs(a[k]), std::abs(b[k])));
    if (!(of_one <= error)) error = std::isnan(of_one) ? kInfinity : of_one;
  }
  return error;
}

void Dop853::PrepareInterpolation(const RightSide& right_side) {
  const auto stage = [this](int j) -> const VectorX& {
    return j < kStages ? stages_[j] : j == kStages ? derivative_ : extra_[j - kStages - 1];
  };
  for (int i = 0; i < 3; ++i) {
    argument_ = step_from_;
    for (int j = 0; j < kStages + 1 + i; ++j) {
      if (kExtraA[i][j] != 0) argument_ += (step_ * kExtraA[i][j]) * stage(j);
    }
    extra_[i].resize(argument_.size());
    right_side(step_start_ + kExtraC[i] * step_, argument_, &extra_[i]);
  }
  interpolation_[0] = step_from_;
  interpolation_[1] = step_to_ - step_from_;
  interpolation_[2] = step_ * stages_[0] - interpolation_[1];
  interpolation_[3] = interpolation_[1] - step_ * derivative_ - interpolation_[2];
  for (int i = 0; i < 4; ++i) {
    interpolation_[4 + i].setZero(step_from_.size());
    for (int j = 0; j < kStages + 4; ++j) {
      if (kD[i][j] != 0) interpolation_[4 + i] += (step_ * kD[i][j]) * stage(j);
    }
  }
}

void Dop853::Interpolate(double t, VectorX* x) const {
  const double s = (t - step_start_) / step_;
  *x = interpolation_[7];
  for (int i = 6; i >= 0; --i) *x = interpolation_[i] + (i % 2 == 0 ? s : 1 - s) * *x;
}

}  // namespace rollgait
