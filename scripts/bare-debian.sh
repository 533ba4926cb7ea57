# To be sourced: bare Debian roots, made with debootstrap. The mirror, and every setting of how to reach it, is that of this
# machine's apt configuration. Roots are kept in $roots (default $ROLLGAIT_ROOTS or /var/tmp/rollgait-roots). The sourcing script has
# fail MESSAGE, which ends it.
#
#   make_bare_root SUITE          makes $roots/SUITE.base unless it is there
#   give_apt_settings SUITE ROOT  lets apt in ROOT reach the archive the way this machine does

roots=${ROLLGAIT_ROOTS:-/var/tmp/rollgait-roots}

find_apt_sources() {
  [ "$(id -u)" = 0 ] || fail "this needs root; run it again as root"
  command -v debootstrap > /dev/null || fail "debootstrap is missing; apt-get install debootstrap"
  host_suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  # One line per index of this machine that comes from Debian: address, suite, component.
  sources=$(apt-get indextargets --format '$(ORIGIN)|$(REPO_URI)|$(RELEASE)|$(COMPONENT)' 'Created-By: Packages' |
    awk -F'|' '$1 == "Debian" {print $2, $3, $4}')
  [ -n "$sources" ] || fail "apt knows no Debian mirror on this machine; run apt-get update and try again"
  mirror=$(awk -v suite="$host_suite" '$2 == suite {print $1; exit}' <<< "$sources")
  [ -n "$mirror" ] || fail "apt has no index of $host_suite; run apt-get update and try again"
}

make_bare_root() {
  local suite=$1 base=$roots/$1.base
  find_apt_sources
  [ -e "$base.complete" ] && return
  echo "Making a bare Debian $suite root in $base."
  mkdir -p "$roots"
  rm -rf "$base"
  debootstrap --variant=minbase "$suite" "$base" "$mirror" || fail "debootstrap failed; its log is in $base/debootstrap"
  rm -f "$base"/var/cache/apt/archives/*.deb
  touch "$base.complete"
}

give_apt_settings() {
  local suite=$1 root=$2
  while read -r uri release component; do
    echo "deb $uri ${release/$host_suite/$suite} $component"
  done <<< "$sources" > "$root/etc/apt/sources.list"
  apt-config dump | grep -E '^Acquire::(Check-|http|https|Retries|AllowInsecure|Languages)' > "$root/etc/apt/apt.conf.d/90host" || true
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  cp -L /etc/hosts "$root/etc/hosts"
}
