/* Unpack the page's program and run it; a browser that cannot do so shows a message above the document. */
gudgeon.unpacked(document.getElementById("gudgeon-program").textContent).then((bytes) => {
    const program = document.createElement("script");
    program.textContent = new TextDecoder().decode(bytes);
    document.head.append(program);
}).catch((error) => {
    const note = document.getElementById("g-error");
    note.textContent = `this browser does not run it: ${error.message}`;
    note.hidden = false;
});
