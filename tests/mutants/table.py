"""The mutants: one fault for every bound of the judge (core/validation) and of the transcription (core/transcription and
core/ocp/constraints). Each row: what the fault is, the source file, a text that occurs once in it, and what stands in its place.
The tests of the same folder must go red; run.py shows it."""

VALIDATION = "core/validation/"
TRANSCRIPTION = "core/transcription/"
CONSTRAINTS = "core/ocp/constraints/"

# The programs with the tests of each folder.
PROGRAMS = {
    VALIDATION: ["core.validation.unit_tests"],
    TRANSCRIPTION: ["core.transcription.unit_tests"],
    CONSTRAINTS: ["core.ocp.unit_tests"],
}


def _bounds(rows):
    """A row for both levels of each criterion: ten times its bound."""
    for field, levels in rows:
        for level, name in enumerate(("standard", "fine")):
            altered = list(levels)
            altered[level] = "10 * " + levels[level]
            yield (f"{field}, {name}: ten times the bound", VALIDATION + "criteria.cc", (field, ", ".join(levels)),
                   ", ".join(altered))


# A pair (after, text) stands for the first place of the text behind the first place of `after`.
MUTANTS = [
    *_bounds([
        ("max_gap_m", ("1e-4", "1e-5")),
        ("max_slip_m_s", ("1e-3", "1e-4")),
        ("max_penetration_m", ("1e-4", "2e-5")),
        ("max_overlap_m", ("1e-6", "2e-7")),
        ("max_position_defect", ("5e-3", "1e-3")),
        ("max_velocity_defect", ("0.2", "0.04")),
        ("max_range_excess", ("0.05 * kDegree", "0.01 * kDegree")),
        ("max_velocity_excess", ("0.01", "2e-3")),
        ("max_effort_excess", ("0.01", "2e-3")),
        ("max_pull_bw", ("1e-3", "2e-4")),
        ("max_friction_excess", ("0.01", "2e-3")),
        ("max_separation_speed_m_s", ("5e-6", "1e-6")),
        ("max_periodicity_error", ("1e-4", "2e-5")),
        ("max_energy_error", ("5e-3", "1e-3")),
        ("max_momentum_error_m_s", ("5e-3", "1e-3")),
    ]),
    ("a bound may be exceeded twofold", VALIDATION + "criteria.cc", "finding.value <= bound", "finding.value <= 2 * bound"),
    ("a criterion without a bound is judged", VALIDATION + "criteria.cc", "if (bound == kInfinity) continue;", ""),
    ("excesses are not in order", VALIDATION + "criteria.cc", "a.ratio() > b.ratio()", "a.ratio() < b.ratio()"),
    ("a measure that is not a number passes", VALIDATION + "findings.cc", "if (!(value <= *worst)) *worst = std::isnan(value) ? kInfinity : value;",
     "if (value > *worst) *worst = value;"),
    ("intervals do not keep their measures", VALIDATION + "findings.cc", "RaiseInterval(criterion, value, at.interval);", ";"),
    ("a finding is not told its place", VALIDATION + "findings.cc", "finding.where = where;", ""),

    # Joints.
    ("the lower end of a range is not judged", VALIDATION + "joint_limits.cc", "Raise(criterion, joint, min - range.min, min_scale, range.min_at);", ""),
    ("the upper end of a range is not judged", VALIDATION + "joint_limits.cc", "Raise(criterion, joint, range.max - max, max_scale, range.max_at);", ""),
    ("the shortcut of joints believes too much", VALIDATION + "joint_limits.cc", "spread += std::abs(c[j]);", "spread += 0.5 * std::abs(c[j]);"),
    ("velocity limit × 100", VALIDATION + "joint_limits.cc", "fastest = joint.velocity_max;", "fastest = 100 * joint.velocity_max;"),
    ("upper effort limit × 100", VALIDATION + "joint_limits.cc", "joint.effort_max, least", "100 * joint.effort_max, least"),
    ("lower effort limit × 100", VALIDATION + "joint_limits.cc", "EffortPolynomial(a, room), joint.effort_min", "EffortPolynomial(a, room), 100 * joint.effort_min"),
    ("excess of effort in N m", VALIDATION + "joint_limits.cc", "most > 0 ? most : larger", "1"),

    # Periodicity and balances.
    ("a mirrored position keeps its sign", VALIDATION + "residuals.cc", "joint.mirror_sign * q[source]", "q[source]"),
    ("a mirrored velocity keeps its sign", VALIDATION + "residuals.cc", "joint.mirror_sign * v[source]", "v[source]"),
    ("the walk need not have gone forward", VALIDATION + "residuals.cc", "end.position[forward] += trajectory.displacement;", ""),
    ("periodicity of positions is not judged", VALIDATION + "residuals.cc", "compare(j, last.node_positions(j, Intervals(last)) - end.position[j]);", ""),
    ("periodicity of velocities is not judged", VALIDATION + "residuals.cc", "compare(j, last.node_velocities(j, Intervals(last)) - end.velocity[j]);", ""),
    ("the work of efforts is left out", VALIDATION + "residuals.cc", "done += weight * power;", ""),
    ("the work of dampers is left out", VALIDATION + "residuals.cc", "done -= weight * model.joint(j).damping * rate * rate;", ""),
    ("the loss of an impact is left out", VALIDATION + "residuals.cc", "work -= phase.impact_loss;", ""),
    ("the impulse of an impact is left out", VALIDATION + "residuals.cc", "impulse += phase.impulses.segment<3>(3 * c);", ";"),
    ("weight does not change momentum", VALIDATION + "residuals.cc", "pushed += weight * dynamics.total_mass() * gravity;", ""),
    ("energy is judged in joules", VALIDATION + "residuals.cc", "scale > 0 ? energy / scale", "scale > 0 ? energy"),
    ("where a manoeuvre ends is not judged", VALIDATION + "residuals.cc", "if (asked.x) RaiseTo(std::abs(body.p_WL.x() - *asked.x), &worst);", ""),
    ("how a manoeuvre ends is not judged", VALIDATION + "residuals.cc", "RaiseTo(actual.angularDistance(*asked.orientation), &worst);", ""),
    ("the spin of a manoeuvre's end is not judged", VALIDATION + "residuals.cc", "RaiseTo((body.R_WL * body.twist.angular - asked.angular_velocity).norm(), &worst);", ""),

    # Impacts.
    ("mirror_sign is left out of an impact", VALIDATION + "jumps.cc", "joint.mirror_sign * v[", "v["),
    ("velocities after an impact are not judged", VALIDATION + "jumps.cc", "log->Raise(Criterion::kVelocityDefect, error, kTouchDown + scene.model.joint(j).name, at);", ""),
    ("an impulse may pull", VALIDATION + "jumps.cc", "judge.AddNormal(c, impulse.z(), at, log);", ""),
    ("the friction of an impulse is not judged", VALIDATION + "jumps.cc", "judge.AddRatio(worst, ratio, at, log);", ";"),
    ("impulses need not balance", VALIDATION + "jumps.cc", "log->Raise(Criterion::kMomentum, missing.norm() / dynamics.total_mass(), \"touch-down\", at);", ""),
    ("a rising foot touches down", VALIDATION + "jumps.cc", "log->Raise(Criterion::kApproach, speed,", "log->Raise(Criterion::kApproach, 0 * speed,"),
    ("a falling foot does not", VALIDATION + "jumps.cc", ".slip.z(), 0.0)", ".slip.norm(), 0.0)"),
    ("the other foot of the mirrored step is old", VALIDATION + "jumps.cc", "contact = scene.contacts[contact].mirror_contact;", ";"),

    # Contacts.
    ("penetration is not judged", VALIDATION + "contact_residuals.cc", "log->Raise(Criterion::kPenetration, std::max(deep, 0.0), name, at);", ""),
    ("penetration is judged where the foot is highest", VALIDATION + "contact_residuals.cc", "return -row(c);", "return row(c);"),
    ("a foot in the air has no gap", VALIDATION + "contact_residuals.cc", "return std::abs(row(c));", "return -row(c);"),
    ("slip is judged along x alone", VALIDATION + "contact_residuals.cc", "std::hypot(row(r), row(r + 1), row(r + 2))", "std::abs(row(r))"),
    ("the polynomial of a normal force is not judged", VALIDATION + "contact_residuals.cc", "judge_.AddNormal(a, range.min,", "judge_.AddNormal(a, range.max,"),
    ("gaps are not resolved in time", VALIDATION + "contact_residuals.cc", "if (!Small(pieces, c, size)) return false;", "static_cast<void>(size);"),

    # Forces.
    ("min_normal_force_bw is ignored", VALIDATION + "force_judge.cc", "bounds_.min_normal - normal", "-normal"),
    ("pull is judged in newtons", VALIDATION + "force_judge.cc", "(bounds_.min_normal - normal) / extremes_->weight()", "bounds_.min_normal - normal"),
    ("friction coefficient × 1.1", VALIDATION + "force_judge.cc", "ratio <= bounds_.friction ?", "ratio <= 1.1 * bounds_.friction ?"),
    ("an unknown ratio of forces passes", VALIDATION + "force_judge.cc", "ratio == kInfinity ? kInfinity : ratio", "ratio"),
    ("the floor of friction × 10", VALIDATION + "force_judge.cc", "kFrictionFloor = 1e-3", "kFrictionFloor = 1e-2"),
    ("forces on one foot are judged one by one", VALIDATION + "force_judge.cc", "Share(rows, tangents.data());", ""),
    ("contacts of two feet share their friction", VALIDATION + "force_judge.cc", "if (contacts_[a].link != contacts_[b].link) continue;", ""),
    ("what a contact does not transmit is shared", VALIDATION + "force_judge.cc", "blocked || !(d.norm()", "!(d.norm()"),
    ("friction is judged at the ends of a piece", VALIDATION + "force_judge.cc", "const Maximum peak = MaximumOverGrid(ratio, grid, {ratios.data(), grid.size()});",
     "const Maximum peak{std::max(ratios[0], ratios[grid.size() - 1]), 0};"),
    ("normal forces are judged at the ends of a piece", VALIDATION + "force_judge.cc", "peak = MaximumOverGrid([&](double theta) { return -ChebyshevBasis::Evaluate(coefficients, row, theta); }, grid,\n                             {pulls.data(), grid.size()});",
     "peak = {std::max(pulls[0], pulls[grid.size() - 1]), 0};"),

    # Re-integration.
    ("defects of velocities are not judged", VALIDATION + "resimulation.cc", "if (with_velocities) Add(Criterion::kVelocityDefect", "if (false) Add(Criterion::kVelocityDefect"),
    ("defects of positions are not judged", VALIDATION + "resimulation.cc", "Add(Criterion::kPositionDefect, j, std::abs(x[j] - q[j]), at, &result_->position);", "static_cast<void>(q);"),
    ("an interval that cannot be integrated passes", VALIDATION + "resimulation.cc", "defects.AddBroken(end);", ""),
    ("the borders of phases are not judged", VALIDATION + "resimulation.cc", "defects.Compare(x, next.node_positions.col(0), next.node_velocities.col(0), !Jumps(next), border);", "static_cast<void>(next);"),
    ("the border of the cycle is not judged", VALIDATION + "resimulation.cc", "defects.Compare(x, start.position, start.velocity, !Jumps(trajectory.phases.front()), border);", ""),
    ("normal forces of the motion are not judged", VALIDATION + "resimulation.cc", "judge_.JudgeNormal(pieces->basis()", "if (false) judge_.JudgeNormal(pieces->basis()"),
    ("friction of the motion is not judged", VALIDATION + "resimulation.cc", "judge_.JudgeFriction(pieces->basis()", "if (false) judge_.JudgeFriction(pieces->basis()"),
    ("the forces within a step are not resolved", VALIDATION + "resimulation.cc", "if (!(ChebyshevBasis::Tail(pieces.coefficients(), row) <= enough)) return false;", "static_cast<void>(enough);"),

    # Bodies.
    ("overlaps between samples are passed over", VALIDATION + "overlap.cc", "Descend(pair, Fraction(std::max(k - 1, 0)), Fraction(std::min(k + 1, kSamples)));", ""),
    ("far bodies are nearer than they are", VALIDATION + "overlap.cc", "if (centres - Reach(a) - Reach(b) > reach) return false;", "if (centres > reach) return false;"),
    ("bodies that are not a number apart do not overlap", VALIDATION + "overlap.cc", "std::isnan(distance) ? -kInfinity", "std::isnan(distance) ? kInfinity"),
    ("overlap is the depth along the first normal", VALIDATION + "body_overlap.cc", "if (best < -kDeep) {", "if (false) {"),
    ("superellipsoids are ellipsoids", VALIDATION + "body_overlap.cc", "body.norm ? (*body.norm)(local) : ", ""),

    # Bounds of the transcription.
    ("no upper end of ranges", TRANSCRIPTION + "bounds.cc", "upper_(layout_.node(k) + j) = joint.position_max;", ""),
    ("no lower end of ranges", TRANSCRIPTION + "bounds.cc", "lower_(layout_.node(k) + j) = joint.position_min;", ""),
    ("no upper limit of velocities", TRANSCRIPTION + "bounds.cc", "upper_(layout_.node(k) + n + j) = joint.velocity_max;", ""),
    ("no lower limit of velocities", TRANSCRIPTION + "bounds.cc", "lower_(layout_.node(k) + n + j) = -joint.velocity_max;", ""),
    ("the ends of a manoeuvre are free", TRANSCRIPTION + "bounds.cc", "TightenNode(layout_.intervals(), problem_.ends->end);", ""),
    ("the start of a manoeuvre is free", TRANSCRIPTION + "bounds.cc", "TightenNode(0, problem_.ends->start);", ""),
    ("the walk slides along x", TRANSCRIPTION + "bounds.cc", "lower_(layout_.node(0) + problem_.forward_joint) = upper_(layout_.node(0) + problem_.forward_joint) = 0;", ""),
    ("the walk slides along y", TRANSCRIPTION + "bounds.cc", "lower_(layout_.node(0) + problem_.lateral_joint) = upper_(layout_.node(0) + problem_.lateral_joint) = 0;", ""),
    ("a phase may last shorter", TRANSCRIPTION + "bounds.cc", "lower_(layout_.duration(p)) = problem_.phases[p].duration.min;", ""),
    ("a phase may last longer", TRANSCRIPTION + "bounds.cc", "upper_(layout_.duration(p)) = problem_.phases[p].duration.max;", ""),
    ("steps may be shorter", TRANSCRIPTION + "bounds.cc", "lower_(layout_.displacement()) = problem_.displacement.min;", ""),
    ("steps may be longer", TRANSCRIPTION + "bounds.cc", "upper_(layout_.displacement()) = problem_.displacement.max;", ""),
    ("impulses may pull", TRANSCRIPTION + "bounds.cc", "lower_(layout_.impulse(p) + active.offset + static_cast<int>(active.directions.size()) - 1) = 0;", "static_cast<void>(active);"),
    ("no limits of velocities before a touch-down", TRANSCRIPTION + "bounds.cc", "upper_.segment(before, n) = upper_.segment(node, n);", ""),
    ("lower effort bound × 100", TRANSCRIPTION + "bounds.cc", "bounds.min / problem_.effort_size()", "100 * bounds.min / problem_.effort_size()"),
    ("upper effort bound × 100", TRANSCRIPTION + "bounds.cc", "bounds.max / problem_.effort_size()", "100 * bounds.max / problem_.effort_size()"),
    ("min_normal_force_bw is ignored at nodes", TRANSCRIPTION + "bounds.cc", "problem_.min_normal_force / problem_.force_size()", "0"),
    ("forces at the border of a phase need not vanish", TRANSCRIPTION + "bounds.cc", "if (zero) upper_(layout_.forces(k, point) + normal) = 0;", "static_cast<void>(zero);"),

    # Rows of the transcription.
    ("min_normal_force_bw is ignored between nodes", TRANSCRIPTION + "interval_path_rows.cc", "problem.min_normal_force / size", "0"),
    ("normal forces between nodes may pull", TRANSCRIPTION + "interval_path_rows.cc", "if (is_point) continue;  // an unknown: it has a bound", "if (is_point || k >= 0) continue;"),
    ("the first coefficient of a new force is free", TRANSCRIPTION + "interval_path_rows.cc", "if (k == 0 && zero_at_start && Contains(taken, contact.contact)) row.at_start = AtZero::kEquals;", ""),
    ("friction of a new force is free", TRANSCRIPTION + "interval_path_rows.cc", "if (k == 0 && zero_at_start && Contains(taken, side.contact)) row.at_start = at_zero(side);", ""),
    ("friction of a force that ends is free", TRANSCRIPTION + "interval_path_rows.cc", "if (k == s - 1 && zero_at_end && Contains(given, side.contact)) row.at_end = at_zero(side);", ""),
    ("lower effort bound × 100 between nodes", TRANSCRIPTION + "interval_path_rows.cc", "bounds.min / size,", "100 * bounds.min / size,"),
    ("upper effort bound × 100 between nodes", TRANSCRIPTION + "interval_path_rows.cc", "bounds.max / size,", "100 * bounds.max / size,"),
    ("lower range and velocity × 100 between nodes", TRANSCRIPTION + "interval_path_rows.cc", "(velocity ? -limits.velocity_max : limits.position_min) / size", "100 * (velocity ? -limits.velocity_max : limits.position_min) / size"),
    ("upper range and velocity × 100 between nodes", TRANSCRIPTION + "interval_path_rows.cc", "(velocity ? limits.velocity_max : limits.position_max) / size", "100 * (velocity ? limits.velocity_max : limits.position_max) / size"),
    ("efforts have any degree", TRANSCRIPTION + "interval_path_rows.cc", "difference /= difference.cwiseAbs().maxCoeff();", "difference.setZero();"),
    ("mirror_sign is left out of periodicity", TRANSCRIPTION + "linear_rows.cc", "const double sign = problem.mirrored ? joint.mirror_sign : 1;", "const double sign = 1;"),
    ("periodicity of positions alone", TRANSCRIPTION + "linear_rows.cc", "layout.jumps(0) ? 1 : 2", "1"),
    ("the walk need not go forward", TRANSCRIPTION + "linear_rows.cc", "if (block == 0 && j == problem.forward_joint) row.terms.emplace_back(layout.displacement(), -1.0);", ""),
    ("speed may be lower", TRANSCRIPTION + "linear_rows.cc", "add_speed(problem.speed.min, 0, kInfinity)", "add_speed(problem.speed.min, -kInfinity, kInfinity)"),
    ("speed may be higher", TRANSCRIPTION + "linear_rows.cc", "add_speed(problem.speed.max, -kInfinity, 0)", "add_speed(problem.speed.max, -kInfinity, kInfinity)"),
    ("the given speed need not be kept", TRANSCRIPTION + "linear_rows.cc", "add_speed(problem.speed.min, 0, 0)", "add_speed(problem.speed.min, -kInfinity, kInfinity)"),
    ("the given duty factor need not be kept", TRANSCRIPTION + "linear_rows.cc", "add_duty(duty.min, 0, 0)", "add_duty(duty.min, -kInfinity, kInfinity)"),
    ("the duty factor may be lower", TRANSCRIPTION + "linear_rows.cc", "add_duty(duty.min, 0, kInfinity)", "add_duty(duty.min, -kInfinity, kInfinity)"),
    ("the duty factor may be higher", TRANSCRIPTION + "linear_rows.cc", "add_duty(duty.max, -kInfinity, 0)", "add_duty(duty.max, -kInfinity, kInfinity)"),
    ("a step may last as long as it likes", TRANSCRIPTION + "linear_rows.cc", "problem.duration.min, problem.duration.max, durations(1)", "-kInfinity, kInfinity, durations(1)"),
    ("positions may jump at a touch-down", TRANSCRIPTION + "linear_rows.cc", "{layout.end_node(layout.first_interval(p) - 1) + j, -1.0}", "{layout.end_node(layout.first_interval(p) - 1) + j, 0.0}"),
    ("mirror_sign is left out of a jump", TRANSCRIPTION + "jump_rows.cc", "const double sign = mirrors ? joint.mirror_sign : 1;", "const double sign = 1;"),
    ("a jump takes the same side's velocity", TRANSCRIPTION + "jump_rows.cc", "mirrors && joint.mirror_joint >= 0 ? joint.mirror_joint : j", "j"),
    ("stages of an explicit method hold velocities", TRANSCRIPTION + "interval_structure.cc", "scheme.tableau().is_explicit ? PointKind::kStage", "false ? PointKind::kStage"),
    ("the dense output of a step misses its end", TRANSCRIPTION + "returned_points.cc", "3 * velocity * tableau.A - 0.5 * first", "3 * velocity * tableau.A"),
    ("returned controls are those of the first stage", TRANSCRIPTION + "returned_points.cc", "LagrangeValues(tableau.c, returned.fractions(r))", "LagrangeValues(tableau.c, 0)"),
    ("linear efforts of shooting jump", TRANSCRIPTION + "linear_rows.cc", "scheme.tableau().joins_efforts() &&", "false &&"),
    ("constant efforts of a phase are joined", TRANSCRIPTION + "linear_rows.cc", "problem.phases[link.phase].effort_degree == 0", "false"),
    ("shooting's efforts have any degree", TRANSCRIPTION + "interval_path_rows.cc", ", scheme.tableau().effort_degree)", ", scheme.points())"),
    ("an impulse has the size of a force", TRANSCRIPTION + "jump_rows.cc", "problem.impulse_size()", "problem.force_size()"),

    # Constraints at an instant.
    ("a swinging foot has no clearance", CONSTRAINTS + "contact_point.cc", "parabola * parabola * parabola * clearance_ : 0", "0.0 : 0"),
    ("a swinging foot must stay low", CONSTRAINTS + "contact_point.cc", "kind_ == Kind::kClearance ? kInfinity : 0", "0"),
    ("a foot that stands may rise", CONSTRAINTS + "contact_point.cc", "kind_ == Kind::kClearance ? kInfinity : 0", "kInfinity"),
    ("rolling velocities are free", CONSTRAINTS + "rolling.cc", ("RollingVelocityConstraint::Bounds", "std::fill_n(upper, rows(), 0.0);"), "std::fill_n(upper, rows(), kInfinity);"),
    ("rolling accelerations are free", CONSTRAINTS + "rolling.cc", ("RollingAccelerationConstraint::Bounds", "std::fill_n(upper, rows(), 0.0);"), "std::fill_n(upper, rows(), kInfinity);"),
    ("nothing carries the efforts", CONSTRAINTS + "dynamics.cc", "std::fill_n(upper, rows(), 0.0);", "std::fill_n(upper, rows(), kInfinity);"),
    ("a foot may rise when it touches down", CONSTRAINTS + "approach.cc", "*upper = kInfinity;", "*upper = kInfinity, *lower = -kInfinity;"),
    ("friction coefficient × 1.01", CONSTRAINTS + "friction.cc", "coefficient * std::cos(side.half_width())", "1.01 * coefficient * std::cos(side.half_width())"),
    ("the pyramid is outside the cone", CONSTRAINTS + "friction.cc", "coefficient * std::cos(side.half_width())", "coefficient"),
    ("friction has no bound", CONSTRAINTS + "friction.cc", "std::fill_n(lower, rows(), 0.0);", "std::fill_n(lower, rows(), -kInfinity);"),
    ("shares of a foot's force are free", CONSTRAINTS + "force_shares.cc", "std::fill_n(upper, rows(), kWidth * Size(0));", "std::fill_n(upper, rows(), kInfinity);"),
    ("bodies may touch", CONSTRAINTS + "separation.cc", "*lower = clearance_;", "*lower = 0;"),
    ("bodies may overlap", CONSTRAINTS + "separation.cc", "*lower = clearance_;", "*lower = -kInfinity;"),
]
