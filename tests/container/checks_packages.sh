# To be sourced by run: the Debian packages, installed in a bare root as docs/how-to/install_on_debian.md says. The page's own commands are
# run; systemctl_by_hand stands for systemctl, since no systemd runs there.
# shellcheck shell=bash

page=docs/how-to/install_on_debian.md

# A copy of the bare root with processes, network and mounts of its own, which end with $holder.
make_package_root() {
  root=$work/package-root
  make_bare_root "$1"
  cp -a "$roots/$1.base" "$root"
  give_apt_settings "$1" "$root"
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"  # no package starts a service
  chmod +x "$root/usr/sbin/policy-rc.d"
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/test"  # 334 packages in a third of the time
  cp $here/systemctl_by_hand "$root/usr/local/bin/systemctl"
  local home=$root/root  # of the user in there
  mkdir -p "$home/build" "$roots/archives-$1/partial"
  cp -r build/packages "$home/build/"
  export root archives=$roots/archives-$1
  # shellcheck disable=SC2016
  unshare --mount --pid --net --fork --kill-child bash -euc '
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/tmp"
    mount --bind "$archives" "$root/var/cache/apt/archives"
    ip link set lo up
    touch "$root/tmp/ready"
    exec sleep infinity' &
  unshare_pid=$!
  disown
  until_true 10 holder_is_ready
  holder=$(pgrep -P $unshare_pid)
}
holder_is_ready() { local pid; pid=$(pgrep -P $unshare_pid) && [ -e "/proc/$pid/root$root/tmp/ready" ]; }
end_package_root() {
  [ -z "${unshare_pid:-}" ] || kill -KILL "$unshare_pid" 2> /dev/null || true
  # Its mounts go a moment after its processes.
  until_true 10 rm -rf --one-file-system "${root:-}"
}
# inside [--online] COMMAND...: as root, in /root; --online: with this machine's network.
inside() {
  local -a net=(--net)
  if [ "$1" = --online ]; then net=(); shift; fi
  nsenter --target "$holder" --mount --pid "${net[@]}" chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" no_proxy="${no_proxy:-}" \
    sh -c 'cd /root && exec "$@"' sh "$@"
}

# The commands of the page's section "From the packages to a plot", a line each.
page_commands() { awk '/^## / {section = /From the packages/} /^```sh$/ {inside = section; next} /^```$/ {inside = 0} inside' $page; }
# page_command N: runs the page's Nth command and says how long it took.
page_command() {
  local line online=() begun
  line=$(page_commands | sed -n "$1p")
  [ -n "$line" ] || { echo "the page has no command $1"; return 1; }
  [ "$1" != 1 ] || online=(--online)
  begun=$(date +%s.%N)
  inside "${online[@]}" bash -c "$line" || return 1
  awk -v n="$1" -v begun="$begun" -v end="$(date +%s.%N)" 'BEGIN {printf "%d %.1f\n", n, end - begun}' >> "$work/page-seconds"
}

# Who hands packages on gives an address, which these have not.
lintian_agrees() {
  local found
  found=$(lintian --allow-root --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog build/packages/*.deb 2>&1) && [ -z "$found" ] ||
    { echo "$found"; return 1; }
}
make_packages() { DEBEMAIL=packages@rollgait.invalid scripts/package --as-built; }
# Those that were made elsewhere.
take_packages() { rm -rf build/packages && mkdir -p build/packages && cp "$1"/*.deb build/packages/; }
units_are_right() {
  local said
  said=$(inside systemd-analyze verify rollgaitd.service rollgait-door.service rollgait-gateway.service 2>&1) && [ -z "$said" ] || { echo "$said"; return 1; }
}
# The door, asked by somebody who is neither root nor of the group rollgait.
stranger() { inside setpriv --reuid 65534 --regid 65534 --clear-groups "$@"; }
packaged_client=(rollgait --server localhost:50051 --tls-ca /etc/rollgait/tls/ca.pem)
as_client() { inside "${packaged_client[@]}" --token-file lab.token "$@"; }
twenty_are_optimal() { equal "$(inside sh -c 'grep -l TERMINATION_OPTIMAL hills/*.json | wc -l')" 20; }
gateway_answers() {
  inside python3 -c '
import ssl, urllib.request
request = urllib.request.Request("https://localhost:50051/v1/models", headers={"Authorization": "Bearer " + open("lab.token").read().strip()})
print(urllib.request.urlopen(request, context=ssl.create_default_context(cafile="/etc/rollgait/tls/ca.pem")).read().decode()[:200])' |
    grep planar
}
python_solves() {
  inside python3 -c '
import importlib.metadata, rollgait
assert importlib.metadata.version("rollgait") == rollgait.__version__
place = rollgait.Connection(server="localhost:50051", tls_ca="/etc/rollgait/tls/ca.pem", token_file="lab.token")
gait = rollgait.Client(place).solve("planar", slope_deg=4, progress=False)
assert gait.termination == "optimal", gait'
}
example_builds() {
  inside sh -c 'cmake -S /usr/share/doc/librollgait-dev/examples/library -B /tmp/one_gait -DCMAKE_BUILD_TYPE=Release && cmake --build /tmp/one_gait &&
    /tmp/one_gait/one_gait 10' | grep 'speed 1.3000 m/s'
}
completions_work() {
  # shellcheck disable=SC2016
  inside bash -c '. /usr/share/bash-completion/completions/rollgait && complete -p rollgait' &&
    inside grep -q '^#compdef rollgait' /usr/share/zsh/vendor-completions/_rollgait &&
    inside grep -q 'complete -c rollgait' /usr/share/fish/vendor_completions.d/rollgait.fish
}
manual_page_is() { inside zcat "/usr/share/man/man$2/$1.$2.gz" | grep "^\.TH ${1^^} $2 "; }
conffiles_are_kept() {
  inside sh -c 'echo "# mine" >> /etc/rollgait/door.env && dpkg -i build/packages/rollgait-server_*.deb && tail -n 1 /etc/rollgait/door.env' | grep '^# mine'
}
# Files that came since the packages were installed, and whatever has the name; what apt and dpkg write for themselves does not count.
leftovers() {
  inside find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /root -o -path /var/log -o -path /var/lib/dpkg -o -path /var/lib/apt -o -path /var/cache \
    -o -path /run \) -prune -o \( -name '*rollgait*' -o -user rollgait -o -user rollgait-gateway -o -group rollgait -o -newercc installed ! -type d \) -print |
    grep -v '^/etc/ld.so.cache$\|^/usr/local/bin/systemctl$' || true
}
nothing_is_left() { local left; left=$(leftovers); [ -z "$left" ] || { echo "$left"; return 1; }; }

# check_packages SUITE prebuilt|DIRECTORY
check_packages() {
  local number command
  case $2 in
    prebuilt) check "scripts/package makes them" make_packages ;;
    *) check "they are in $2" take_packages "$2" ;;
  esac
  if command -v lintian > /dev/null; then
    check "lintian finds no error and nothing to warn of" lintian_agrees
  else
    echo "  --    lintian is not installed: not asked"
  fi
  make_package_root "$1"
  for number in 1 2 3 4; do
    check "the page's command: $(page_commands | sed -n "${number}p" | cut -c1-90)" page_command $number
    [ $number != 1 ] || inside touch installed
    [ $number != 1 ] || check "systemd finds nothing wrong with the units" units_are_right
  done
  check "the units are enabled" inside ls /etc/systemd/system/multi-user.target.wants/rollgait{d,-door,-gateway}.service
  check "the state is the server's alone" equal "$(inside stat -c '%U:%G %a' /var/lib/rollgait)" 'rollgait:rollgait 700'
  check "the server's key is for root and the door" equal "$(inside stat -c '%U:%G %a' /etc/rollgait/tls/server.key)" 'root:rollgait 640'
  check "the authority's key is root's alone" equal "$(inside stat -c '%U:%G %a' /etc/rollgait/tls/ca.key)" 'root:root 600'
  check "the server answers through the door" until_true 20 as_client server-info
  check "without a token it refuses" refused_with UNAUTHENTICATED stranger "${packaged_client[@]}" list
  check "the gateway answers through the door" gateway_answers
  check "the client solves a gait" as_client -q solve --model planar --slope 3
  check "Python solves a gait" python_solves
  for number in 5 6 7 8; do
    check "the page's command: $(page_commands | sed -n "${number}p" | cut -c1-90)" page_command $number
  done
  check "the page has no more" equal "$(page_commands | wc -l)" 8
  check "twenty gaits are optimal" twenty_are_optimal
  check "files for OpenSim and the plot are there" inside sh -c 'ls uphill/*.osim uphill/*.mot && test -s uphill.png && test -s hills.html && test -s hills.csv'
  check "the library's example builds and solves" example_builds
  check "completions load" completions_work
  for command in "rollgait 1" "rollgaitd 1" "rollgait-agent 1" "rollgait-gateway 1" "rollgait-make-certificates 8"; do
    # shellcheck disable=SC2086
    check "manual page: $command" manual_page_is $command
  done
  check "SIGTERM ends the server with exit code 0" inside systemctl stop rollgaitd
  check "what is changed in /etc stays when the package is installed again" conffiles_are_kept
  check "they are purged" inside apt-get purge -y rollgait-server rollgait python3-rollgait librollgait-dev
  check "nothing is left but the two users" nothing_is_left
  check "  who are locked" inside sh -c 'getent passwd rollgait rollgait-gateway | grep -c /usr/sbin/nologin | grep -x 2'
  awk '{ printf "  page, command %d: %s s\n", $1, $2; sum += $2 } END { printf "  page, all: %.1f s\n", sum }' "$work/page-seconds"
  end_package_root
}
