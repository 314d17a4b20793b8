// Starts preview.html: unpacks the viewer (viewer.js), which stands in the page as compressed text. No network.
'use strict';
(async () => {
const packed = Uint8Array.from(atob(document.getElementById('viewer').textContent.trim()), c => c.charCodeAt(0));
const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
const script = document.createElement('script');
script.textContent = await new Response(stream).text();
document.body.append(script);
})().catch(() => {
document.getElementById('fallback').hidden = false;
document.getElementById('view').hidden = true;
document.getElementById('footer').hidden = true;
});
