// The instant that plots and scene share, in % of the cycle (of a manoeuvre: of its duration).
const followers = []; // {element, follow, seen}
let instant = 0;

const watcher = new IntersectionObserver(
  (entries) => {
    for (const entry of entries) {
      for (const follower of followers.filter((f) => f.element === entry.target)) {
        follower.seen = entry.isIntersecting;
        if (follower.seen) follower.follow(instant);
      }
    }
  },
  { rootMargin: "100px" },
);

// Calls follow(percent) with every new instant while the element is on the screen; once now, and when it comes there.
function followInstant(element, follow) {
  followers.push({ element, follow, seen: false });
  watcher.observe(element);
  follow(instant);
}

function showPercent(percent) {
  instant = percent;
  for (const follower of followers) if (follower.seen) follower.follow(percent);
}
