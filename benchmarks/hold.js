// Moves the slider so many times a second, to and fro, whatever the page makes of it.
async ([selector, rate, seconds]) => {
  const handle = document.querySelector(selector);
  handle.focus();
  const start = performance.now();
  let moves = 0;
  const move = () => {
    const key = Math.floor(moves / 40) % 2 ? "ArrowLeft" : "ArrowRight";
    window.watch.reading = moves >= rate * seconds - 1; // only what follows the last move
    handle.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
    moves += 1;
  };
  await new Promise((done) => {
    const timer = setInterval(() => {
      const due = Math.min((performance.now() - start) / 1000, seconds) * rate;
      while (moves < due) move();
      if (moves >= rate * seconds) {
        clearInterval(timer);
        done();
      }
    }, 1000 / rate);
  });
  return { moves, start, end: window.watch.keys.at(-1) };
}
