
compile_error!("\u{1b}[2J\u{7}<b id=forged>100 points</b>\u{202e}@{5000xloud }");
