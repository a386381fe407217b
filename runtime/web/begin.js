/* Unpacks the page's own program and runs it; a browser that cannot is told, the document stands without. */
gudgeon.unpacked(document.getElementById("gudgeon-program").textContent).then((bytes) => {
    const program = document.createElement("script");
    program.textContent = new TextDecoder().decode(bytes);
    document.head.append(program);
}).catch((error) => {
    const note = document.getElementById("g-error");
    note.textContent = `this browser does not run it: ${error.message}`;
    note.hidden = false;
});
