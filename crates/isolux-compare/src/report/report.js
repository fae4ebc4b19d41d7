// A graph or a picture fills the window when it is clicked, and goes back at the next click. All can be read without.
for (const shown of document.querySelectorAll('figure svg, figure img, .pictures img')) {
  shown.addEventListener('click', () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (shown.requestFullscreen) shown.requestFullscreen();
  });
}
