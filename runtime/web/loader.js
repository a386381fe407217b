/* Unpack the page's program and run it; a browser that cannot do so shows a message above the document. */
(async () => {
    const text = document.getElementById("gudgeon-program").textContent;
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const program = document.createElement("script");
    program.textContent = await new Response(stream).text();
    document.head.append(program);
})().catch((error) => {
    const errorBox = document.getElementById("g-error");
    errorBox.textContent = `this browser does not run it: ${error.message}`;
    errorBox.hidden = false;
});
